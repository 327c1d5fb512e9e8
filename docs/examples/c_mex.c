/* MEX file for Octave and MATLAB: [theta, beta, edp] = fragility(wall, catalogue, im, levels); wall is a struct of properties */
#include <dondolo.h>
#include <mex.h>
#include <stdio.h>

static const char *fill(dondolo_error *error, dondolo_settings *settings, const char *name, const mxArray *value)
{
   if (mxIsChar(value)) {
      char *text = mxArrayToString(value);
      dondolo_set_text(error, settings, name, text);
      mxFree(text);
   } else if (!mxIsDouble(value) || mxIsComplex(value))
      return "a property must be a text or real numbers";
   else if (mxGetNumberOfElements(value) == 1)
      dondolo_set_number(error, settings, name, mxGetScalar(value));
   else
      dondolo_set_list(error, settings, name, mxGetPr(value), (int)mxGetNumberOfElements(value));
   return NULL;
}

void mexFunction(int results, mxArray *result[], int count, const mxArray *given[])
{
   if (count != 4 || results > 3 || !mxIsStruct(given[0]) || !mxIsChar(given[1]) || !mxIsChar(given[2]) || !mxIsDouble(given[3]))
      mexErrMsgTxt("usage: [theta, beta, edp] = fragility(wall, catalogue, im, levels)");
   char *catalogue = mxArrayToString(given[1]), message[2048] = "";
   const char *wrong = NULL;
   int levels = (int)mxGetNumberOfElements(given[3]);
   dondolo_error *error = dondolo_new_error();
   dondolo_settings *properties = dondolo_new_settings(error, "wall"), *how = dondolo_new_settings(error, "stripes");
   for (int i = 0; i < mxGetNumberOfFields(given[0]) && !wrong; i++)
      wrong = fill(error, properties, mxGetFieldNameByNumber(given[0], i), mxGetFieldByNumber(given[0], 0, i));
   if (!wrong)
      wrong = fill(error, how, "im", given[2]);
   dondolo_set_list(error, how, "levels", mxGetPr(given[3]), levels);

   dondolo_wall *wall = dondolo_new_wall(error, properties);
   dondolo_records *records = dondolo_read_records(error, catalogue, 0.0);
   dondolo_stripes *stripes = dondolo_run_stripes(error, wall, records, how, NULL, 0);
   dondolo_curve *curve = dondolo_fit_stripes(error, stripes, 0.0);
   result[0] = mxCreateDoubleScalar(dondolo_get_number(error, curve, "theta"));
   if (results > 1)
      result[1] = mxCreateDoubleScalar(dondolo_get_number(error, curve, "beta"));
   if (results > 2 && dondolo_status(error) == 0) {
      int histories = dondolo_count(error, stripes, "edp");
      result[2] = mxCreateDoubleMatrix(histories / levels, levels, mxREAL);
      dondolo_get_numbers(error, stripes, "edp", mxGetPr(result[2]), histories);
   }
   if (dondolo_status(error) != 0)
      snprintf(message, sizeof message, "%s", dondolo_message(error));
   void *made[] = {curve, stripes, records, wall, how, properties, error};
   for (int i = 0; i < 7; i++)
      dondolo_free(made[i]);
   mxFree(catalogue);
   if (wrong || message[0])
      mexErrMsgTxt(wrong ? wrong : message);
}
