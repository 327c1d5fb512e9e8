/* Every function of dondolo.h, also as it must not be called: test_c_interface.py runs it under valgrind. */
#include <dondolo.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static dondolo_error *error;
static int expected, others;

/* An error of this code must have come */
static void fails(int code, const char *where)
{
   if (dondolo_status(error) == code && dondolo_message(error)[0] != '\0')
      expected++;
   else
      printf("%s: status %d, must be %d: %s\n", where, dondolo_status(error), code, dondolo_message(error)), others++;
   dondolo_clear_error(error);
}

static void holds(int what, const char *where)
{
   if (!what || dondolo_status(error) != 0)
      printf("%s: %s\n", where, dondolo_message(error)), others++;
   dondolo_clear_error(error);
}

static dondolo_wall *wall_of(const char *mechanism, double height, double thickness)
{
   dondolo_settings *properties = dondolo_new_settings(error, "wall");
   dondolo_set_text(error, properties, "mechanism", mechanism);
   dondolo_set_number(error, properties, "height", height);
   dondolo_set_number(error, properties, "thickness", thickness);
   dondolo_wall *wall = dondolo_new_wall(error, properties);
   dondolo_free(properties);
   return wall;
}

/* What is wrong with a wall, sentence by sentence; lines, numbers and names that there are not have nothing */
static void problems(void)
{
   char text[100];
   const char *wrong[] = {"height", "thickness"};

   dondolo_free(wall_of("one_sided", -1.0, 0.0));
   for (int i = 0; i < 2; i++) {
      int length = dondolo_get_problem(error, i, "code", text, sizeof text);
      int same = length == 12 && strcmp(text, "out_of_range") == 0;
      length = dondolo_get_problem(error, i, "variable", text, sizeof text);
      same = same && length == (int)strlen(wrong[i]) && strcmp(text, wrong[i]) == 0;
      if (!same || dondolo_get_problem(error, i, "place", text, sizeof text) != 0)
         printf("problem %d: %s\n", i, text), others++;
   }
   if (dondolo_get_problem(error, 2, "code", text, sizeof text) != -1 || dondolo_get_problem(error, -1, "code", NULL, 0) != -1 ||
       dondolo_get_problem(error, 0, "cod", text, 1) != -1 || dondolo_get_problem(error, 0, NULL, text, -1) != -1 ||
       dondolo_get_problem(NULL, 0, "code", text, sizeof text) != -1 || dondolo_get_problem(error, 0, "code", NULL, 9) != 12)
      printf("problems that there are not\n"), others++;
   fails(DONDOLO_INPUT, "two things wrong");
   if (dondolo_get_problem(error, 0, "code", text, sizeof text) != -1)
      printf("a problem after clearing\n"), others++;
}

static void settings(void)
{
   const char *wrong[] = {"", "heigth", "a name that is far too long for any variable of a case or of a table of walls", "\n"};
   dondolo_settings *properties = dondolo_new_settings(error, "wall");
   double values[2] = {1.0, NAN};

   for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
      dondolo_set_number(error, properties, wrong[i], 1.0), fails(DONDOLO_INPUT, "wrong name");
      dondolo_set_text(error, properties, wrong[i], "x"), fails(DONDOLO_INPUT, "wrong name");
      dondolo_set_list(error, properties, wrong[i], values, 1), fails(DONDOLO_INPUT, "wrong name");
   }
   dondolo_set_number(error, properties, "height", NAN), fails(DONDOLO_INPUT, "NaN");
   dondolo_set_number(error, properties, "mechanism", 1.0), fails(DONDOLO_INPUT, "number for a text");
   dondolo_set_text(error, properties, "height", "6"), fails(DONDOLO_INPUT, "text for a number");
   dondolo_set_list(error, properties, "load", values, 2), fails(DONDOLO_INPUT, "NaN in a list");
   dondolo_set_list(error, properties, "height", values, 2), fails(DONDOLO_INPUT, "list for a number");
   dondolo_set_list(error, properties, "load", NULL, 2), fails(DONDOLO_INPUT, "NULL for a list");
   dondolo_set_list(error, properties, "load", values, 0), fails(DONDOLO_INPUT, "empty list");
   dondolo_set_text(error, properties, "mechanism", NULL), fails(DONDOLO_INPUT, "NULL for a text");
   dondolo_set_text(error, properties, NULL, "x"), fails(DONDOLO_INPUT, "NULL for a name");
   dondolo_new_wall(error, NULL), fails(DONDOLO_INPUT, "wall of nothing");
   dondolo_new_wall(error, properties), fails(DONDOLO_INPUT, "wall without properties");
   dondolo_new_settings(error, "walls"), fails(DONDOLO_INPUT, "no such group");
   dondolo_new_settings(error, NULL), fails(DONDOLO_INPUT, "NULL for a group");
   dondolo_free(properties);
   dondolo_free(properties);
   dondolo_set_number(error, properties, "height", 1.0), fails(DONDOLO_INPUT, "settings that were freed");
}

static void records(const char *catalogue)
{
   double samples[300], dt[] = {0.01, 0.02};
   int lengths[] = {100, 200};
   const char *names[] = {"one", "two"};

   for (int i = 0; i < 300; i++)
      samples[i] = 3.0 * sin(0.3 * i);
   dondolo_records *made = dondolo_new_records(error, 2, lengths, dt, samples, names);
   holds(dondolo_count(error, made, "pga") == 2, "records of arrays");
   dondolo_free(made);
   dt[1] = NAN;
   dondolo_new_records(error, 2, lengths, dt, samples, names), fails(DONDOLO_INPUT, "time step that is none");
   dondolo_new_records(error, 2, lengths, NULL, samples, names), fails(DONDOLO_INPUT, "NULL for time steps");
   dondolo_new_records(error, 0, NULL, NULL, NULL, NULL), fails(DONDOLO_INPUT, "no records");
   dondolo_read_records(error, "none.csv", 0.0), fails(DONDOLO_MISSING, "no catalogue");
   dondolo_read_records(error, NULL, 0.0), fails(DONDOLO_INPUT, "NULL for a path");
   dondolo_read_records(error, catalogue, 1.0), fails(DONDOLO_INPUT, "no vertical components");
   dondolo_read_record(error, "none.txt", 0.0, NULL), fails(DONDOLO_MISSING, "no file");
   dondolo_read_record(error, catalogue, NAN, NULL), fails(DONDOLO_INPUT, "NaN for a time step");
}

static void runs(const char *catalogue)
{
   double levels[] = {0.6, 1.2}, collapses[2], counts[] = {44.0, 44.0}, *edp;
   char text[64];
   dondolo_records *suite = dondolo_read_records(error, catalogue, 0.0);
   dondolo_wall *wall = wall_of("one_sided", 6.0, 0.5);
   dondolo_settings *how = dondolo_new_settings(error, "stripes"), *solver = dondolo_new_settings(error, "solver");

   dondolo_run_stripes(error, wall, suite, how, NULL, 0), fails(DONDOLO_INPUT, "no levels");
   dondolo_set_list(error, how, "levels", levels, 2);
   dondolo_set_number(error, solver, "rtol", 1e-7);
   dondolo_stripes *stripes = dondolo_run_stripes(error, wall, suite, how, solver, 2);
   holds(dondolo_get_numbers(error, stripes, "collapses", collapses, 2) == 0, "collapses");
   edp = malloc(88 * sizeof *edp);
   holds(dondolo_count(error, stripes, "edp") == 88 && dondolo_get_numbers(error, stripes, "edp", edp, 88) == 0, "EDPs");
   dondolo_get_numbers(error, stripes, "edp", edp, 87), fails(DONDOLO_INPUT, "too little room");
   free(edp);
   dondolo_get_number(error, stripes, "edp"), fails(DONDOLO_INPUT, "one number of a list");
   dondolo_get_number(error, stripes, "edps"), fails(DONDOLO_INPUT, "no such number");
   dondolo_get_text(error, stripes, "status", text, sizeof text), fails(DONDOLO_INPUT, "no such text");
   holds(dondolo_get_text(error, stripes, "im", text, 3) == 3 && strcmp(text, "pg") == 0, "a text that is cut");
   holds(dondolo_get_text(error, stripes, "warnings", NULL, 0) >= 0, "length of a text");
   dondolo_curve *curve = dondolo_fit_stripes(error, stripes, 0.0);
   holds(dondolo_get_number(error, curve, "theta") > 0.0, "curve");
   dondolo_fit_stripes(error, stripes, 2.0), fails(DONDOLO_INPUT, "threshold beyond the limit");
   dondolo_fit_stripes(error, (dondolo_stripes *)curve, 0.0), fails(DONDOLO_INPUT, "curve for stripes");
   dondolo_free(curve);
   curve = dondolo_fit_counts(error, 2, levels, collapses, counts);
   holds(dondolo_get_text(error, curve, "status", text, sizeof text) > 0, "curve of counts");
   dondolo_fit_counts(error, 2, levels, counts, collapses), fails(DONDOLO_INPUT, "counts that cannot be");
   dondolo_history *history = dondolo_run_history(error, wall, suite, 3, 1.5, 0.0, 0.0, NULL);
   holds(dondolo_count(error, history, "rotation") > 1000, "history");
   /* A wall that is let go at half of its capacity */
   double start = 0.5 * dondolo_get_number(error, wall, "capacity_angle"), rotation[2];
   dondolo_history *released = dondolo_run_history(error, wall, suite, 3, 0.0, start, 0.0, NULL);
   holds(fabs(dondolo_get_number(error, released, "edp") - 0.5) < 1e-12, "largest rotation of a wall that is let go");
   int rows = dondolo_count(error, released, "rotation");
   double *rotations = malloc(rows * sizeof *rotations);
   dondolo_get_numbers(error, released, "rotation", rotations, rows);
   rotation[0] = rotations[0], rotation[1] = rotations[rows - 1];
   holds(rotation[0] == start && rotation[1] == 0.0, "from the start to rest");
   free(rotations);
   dondolo_free(released);
   dondolo_run_history(error, wall, suite, 3, 0.0, 3.0 * start, 0.0, NULL), fails(DONDOLO_INPUT, "beyond the capacity");
   dondolo_run_history(error, wall, suite, 3, 0.0, start, NAN, NULL), fails(DONDOLO_INPUT, "NaN for a velocity");
   dondolo_run_history(error, wall, suite, 44, 1.0, 0.0, 0.0, NULL), fails(DONDOLO_INPUT, "no such record");
   dondolo_run_history(error, wall, suite, 0, NAN, 0.0, 0.0, NULL), fails(DONDOLO_INPUT, "NaN for a scale");
   /* Results stay when what they are of is freed. */
   dondolo_free(suite);
   dondolo_run_stripes(error, wall, suite, how, solver, 1), fails(DONDOLO_INPUT, "records that were freed");
   dondolo_free(wall);
   dondolo_free(curve);
   curve = dondolo_fit_stripes(error, stripes, 0.5);
   holds(dondolo_count(error, curve, "covariance") == 3, "curve of stripes whose wall was freed");
   void *made[] = {stripes, curve, history, how, solver};
   for (size_t i = 0; i < sizeof made / sizeof *made; i++)
      dondolo_free(made[i]);
}

int main(int argc, char **argv)
{
   if (argc != 2)
      return 2;
   error = dondolo_new_error();
   holds(dondolo_get_version()[0] != '\0', "version");
   settings();
   problems();
   records(argv[1]);
   runs(argv[1]);
   dondolo_listen();
   dondolo_end_listening();
   dondolo_free(error);
   if (dondolo_status(error) != DONDOLO_INPUT)
      others++;
   printf("%d errors as expected, %d others\n", expected, others);
   return others;
}
