/* dondolo: fragility of masonry walls that rock and overturn in earthquakes. The interface for C, and for what calls C.
 *
 * Everything is reached by handles, which are pointers that nobody may look behind. dondolo_free frees any of them; NULL, a
 * handle that was freed and one of something else are refused with a text, wherever they are given.
 *
 * Every call that can fail takes a handle of errors first. It keeps the first error, its code and its text, and as long as one
 * is in it all calls that are given it do nothing: they return NULL, the code, -1 or NaN. A program may look once, at the end.
 *
 * Numbers are in SI units unless their variable says otherwise, and texts are UTF-8, ended by NUL. Arrays belong to the caller;
 * what is made of them is a copy. Any number of threads may call, each with a handle of errors of its own; what others use must
 * not be freed or set meanwhile.
 */
#ifndef DONDOLO_H
#define DONDOLO_H

#ifdef __cplusplus
extern "C" {
#endif

typedef struct dondolo_error dondolo_error;
typedef struct dondolo_settings dondolo_settings;
typedef struct dondolo_records dondolo_records;
typedef struct dondolo_wall dondolo_wall;
typedef struct dondolo_stripes dondolo_stripes;
typedef struct dondolo_curve dondolo_curve;
typedef struct dondolo_history dondolo_history;

/* Codes of errors: work that failed or was interrupted, wrong input, a file that does not exist, lack of memory */
enum { DONDOLO_FAILURE = 1, DONDOLO_INPUT = 2, DONDOLO_MISSING = 3, DONDOLO_MEMORY = 4 };

/* Version of the library, such as "1.0.0" */
const char *dondolo_get_version(void);

/* Free what any handle stands for. NULL and handles that were freed before do nothing. */
void dondolo_free(void *handle);

/* Errors: a handle; the code in it, 0 for none; its text, which stays until the next error, clearing or freeing; of the
 * sentence in line number (from 0) of the text, by name, the "code" of what is wrong, the "variable" and the "place", empty if
 * not known (docs/files.md lists the codes); clearing. dondolo_get_problem returns as dondolo_get_text does, and -1 where there
 * is no such sentence or name. */
dondolo_error *dondolo_new_error(void);
int dondolo_status(const dondolo_error *error);
const char *dondolo_message(const dondolo_error *error);
int dondolo_get_problem(const dondolo_error *error, int number, const char *name, char *text, int size);
void dondolo_clear_error(dondolo_error *error);

/* Settings of a group, "wall", "stripes" or "solver", by the names that the variables have in cases. "wall" has those of
 * &wall, those of &building and gravity; "stripes" has im, levels and polarity; "solver" has engine, rtol, atol, edp_limit and
 * estimate_error. A logical is 1 or 0. What is not set has its default. */
dondolo_settings *dondolo_new_settings(dondolo_error *error, const char *group);
int dondolo_set_number(dondolo_error *error, dondolo_settings *settings, const char *name, double value);
int dondolo_set_list(dondolo_error *error, dondolo_settings *settings, const char *name, const double *values, int count);
int dondolo_set_text(dondolo_error *error, dondolo_settings *settings, const char *name, const char *value);

/* Records: of a catalogue, with their vertical components times a factor unless it is 0; the one accelerogram of a file, whose
 * time step [s] and units are those that the file states where 0 and NULL are given; or of arrays: numbers of samples, time
 * steps [s], the samples of all, one record after the other [m/s2], and names, or NULL for their numbers.
 * A file of plain columns that does not say what they are needs a catalogue, with its column columns. */
dondolo_records *dondolo_read_records(dondolo_error *error, const char *catalogue, double vertical_factor);
dondolo_records *dondolo_read_record(dondolo_error *error, const char *file, double dt, const char *units);
dondolo_records *dondolo_new_records(dondolo_error *error, int count, const int *lengths, const double *dt,
                                     const double *samples, const char *const *names);

/* A wall, on a building if its settings say so */
dondolo_wall *dondolo_new_wall(dondolo_error *error, const dondolo_settings *wall);

/* Stripes of a wall. solver may be NULL: the defaults. threads 0: all that OpenMP gives; results are the same to the bit for
 * any number. */
dondolo_stripes *dondolo_run_stripes(dondolo_error *error, const dondolo_wall *wall, dondolo_records *records,
                                     const dondolo_settings *stripes, const dondolo_settings *solver, int threads);

/* A fragility curve: of the histories of stripes that reach a threshold of the EDP, 0 for collapse, with standard errors that
 * are clustered by event or record; or of counts at each level, with those of independent histories. A curve that cannot be
 * is no error: its text "status" says why, and its numbers are NaN. */
dondolo_curve *dondolo_fit_stripes(dondolo_error *error, const dondolo_stripes *stripes, double edp_threshold);
dondolo_curve *dondolo_fit_counts(dondolo_error *error, int count, const double *levels, const double *collapses,
                                  const double *histories);

/* The motion of a wall under record number (from 0) times scale, negative to reverse it. It begins with a rotation [rad] and a
 * velocity [rad/s], signed as those of the history, 0 and 0 at rest. solver may be NULL. */
dondolo_history *dondolo_run_history(dondolo_error *error, const dondolo_wall *wall, dondolo_records *records, int number,
                                     double scale, double initial_rotation, double initial_velocity,
                                     const dondolo_settings *solver);

/* Numbers and texts of a handle, by name. Flags are 1 or 0. In lists of histories those of the lowest level come first.
 *
 * records   samples, dt, pga [m/s2], cluster;                                       texts names (a line each), warnings
 * wall      gravity, radius, slenderness_angle, frequency_parameter, trigger_acceleration, capacity_angle,
 *           restitution_coefficient, base_hinge_depth, greatest_acceleration, plastic_acceleration, support_share,
 *           support_tilt, misfit, opening_edp, opening_acceleration, elastic_restitution, two_sided;
 *                                                                                   texts name, mechanism
 * stripes   edp_limit; of each level levels, histories, collapses; of each history of a level record (from 0), polarity,
 *           cluster; of each history scale, ran, edp, collapsed, impacts, time_of_peak, edp_error;   texts im, warnings
 * curve     has_curve, theta, beta, has_errors, se_ln_theta, se_beta, covariance (of ln theta, of both, of beta), clusters,
 *           degrees_of_freedom, log_likelihood, bracket (2), deviance, deviance_dof;   texts status, errors, warnings
 * history   edp, collapsed, impacts, time_of_peak, edp_error; of each row time, acceleration, rotation, velocity, side,
 *           after_impact;                                                           text warnings
 * settings                                                                          text variables (a line each)
 */
int dondolo_count(dondolo_error *error, const void *handle, const char *name);
double dondolo_get_number(dondolo_error *error, const void *handle, const char *name);
int dondolo_get_numbers(dondolo_error *error, const void *handle, const char *name, double *values, int count);
/* Returns the length of the whole text, without the NUL that ends it; what has no room in size bytes is cut off. */
int dondolo_get_text(dondolo_error *error, const void *handle, const char *name, char *text, int size);

/* Between the two, runs that this thread starts end at a SIGINT with an error, if the program has a handler for it, which is
 * called too. Without them, or without a handler, SIGINT does to a program what it does to any. */
void dondolo_listen(void);
void dondolo_end_listening(void);

#ifdef __cplusplus
}
#endif

#endif
