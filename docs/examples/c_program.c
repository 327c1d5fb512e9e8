/* The median of a facade's fragility curve: cc c_program.c $(pkg-config --cflags --libs dondolo) */
#include <dondolo.h>
#include <stdio.h>

int main(int argc, char **argv)
{
   const double levels[] = {0.4, 0.6, 0.8, 1.0, 1.2};
   double collapses[5];
   char status[20];
   dondolo_error *error = dondolo_new_error();

   if (argc != 2) {
      fprintf(stderr, "usage: %s CATALOGUE\n", argv[0]);
      return 2;
   }
   dondolo_settings *properties = dondolo_new_settings(error, "wall");
   dondolo_set_text(error, properties, "mechanism", "one_sided");
   dondolo_set_number(error, properties, "height", 3.0);
   dondolo_set_number(error, properties, "thickness", 0.25);
   dondolo_settings *how = dondolo_new_settings(error, "stripes");
   dondolo_set_text(error, how, "im", "pga");
   dondolo_set_list(error, how, "levels", levels, 5);

   dondolo_wall *wall = dondolo_new_wall(error, properties);
   dondolo_records *records = dondolo_read_records(error, argv[1], 0.0);
   dondolo_stripes *stripes = dondolo_run_stripes(error, wall, records, how, NULL, 0);
   dondolo_curve *curve = dondolo_fit_stripes(error, stripes, 0.0);
   dondolo_get_numbers(error, stripes, "collapses", collapses, 5);
   dondolo_get_text(error, curve, "status", status, sizeof status);
   double theta = dondolo_get_number(error, curve, "theta"), beta = dondolo_get_number(error, curve, "beta");

   int failed = dondolo_status(error);
   if (failed)
      fprintf(stderr, "%s\n", dondolo_message(error));
   else {
      for (int i = 0; i < 5; i++)
         printf("%.1f g: %2.0f collapses\n", levels[i], collapses[i]);
      printf("theta = %.3f g, beta = %.3f (%s)\n", theta, beta, status);
   }
   void *made[] = {curve, stripes, records, wall, how, properties, error};
   for (int i = 0; i < 7; i++)
      dondolo_free(made[i]);
   return failed;
}
