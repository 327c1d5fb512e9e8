// SUNDIALS with its own root finding, by three methods.
// adams: CVODE (Adams, fixed-point iteration), stopped at every sample, restarted after impacts.
// adams_free: the same without stops at samples.
// dopri5: ARKODE's explicit Dormand-Prince pair, stopped at every sample.
// The setting is the relative tolerance.
#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_config.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <memory>

#include "hybrid.hpp"

namespace {

void check(int flag, const char *what) {
   if (flag >= 0) return;
   std::fprintf(stderr, "SUNDIALS: %s failed with %d\n", what, flag);
   std::exit(1);
}

// Data of the right-hand side
struct Scene {
   const Wall &wall;
   const Ground *ground = nullptr;
   double entered = 0.0;  // time of the sample at the start of the present interval
   bool free = false;

   double push(double t) const {
      if (!free) return ground->push(t - entered);
      const double x = t / ground->record.dt;
      const int i = std::min(static_cast<int>(x), ground->last() - 1);
      const double here = ground->sample(i);
      return ground->side * (here + (ground->sample(i + 1) - here) * (x - i));
   }
};

int right_side(double t, N_Vector y, N_Vector ydot, void *data) {
   const Scene &scene = *static_cast<Scene *>(data);
   const double *state = N_VGetArrayPointer(y);
   double *rate = N_VGetArrayPointer(ydot);
   rate[0] = state[1];
   rate[1] = acceleration(scene.wall, state[0], scene.push(t));
   return 0;
}

int roots(double, N_Vector y, double *gap, void *data) {
   const double *state = N_VGetArrayPointer(y);
   gap[0] = state[0];
   gap[1] = state[1];
   const double capacity = static_cast<Scene *>(data)->wall.capacity;
   gap[2] = state[0] - capacity;
   // A root at the start hides those that follow at once: a wall that starts exactly at the threshold and falls back.
   gap[3] = state[0] + 1e-9 * capacity;
   return 0;
}

int directions[] = {-1, -1, 1, -1};  // directions of the roots

class Cvode {
 public:
   Cvode(SUNContext context, N_Vector y, N_Vector atol, double rtol, Scene *scene)
      : memory(CVodeCreate(CV_ADAMS, context)), iteration(SUNNonlinSol_FixedPoint(y, 0, context)) {
      check(CVodeInit(memory, right_side, 0.0, y), "CVodeInit");
      check(CVodeSVtolerances(memory, rtol, atol), "CVodeSVtolerances");
      check(CVodeSetNonlinearSolver(memory, iteration), "CVodeSetNonlinearSolver");
      check(CVodeSetUserData(memory, scene), "CVodeSetUserData");
      check(CVodeRootInit(memory, 4, roots), "CVodeRootInit");
      check(CVodeSetRootDirection(memory, directions), "CVodeSetRootDirection");
      check(CVodeSetNoInactiveRootWarn(memory), "CVodeSetNoInactiveRootWarn");
      check(CVodeSetMaxNumSteps(memory, 1000000), "CVodeSetMaxNumSteps");
   }
   void restart(double t, N_Vector y) { check(CVodeReInit(memory, t, y), "CVodeReInit"); }
   void stop_at(double t) { check(CVodeSetStopTime(memory, t), "CVodeSetStopTime"); }
   int go(double end, N_Vector y, double *t) { return CVode(memory, end, y, t, CV_NORMAL); }
   void found(int *which) { check(CVodeGetRootInfo(memory, which), "CVodeGetRootInfo"); }
   static constexpr int at_root = CV_ROOT_RETURN;

 private:
   void *memory;
   SUNNonlinearSolver iteration;
};

class ErkStep {
 public:
   ErkStep(SUNContext context, N_Vector y, N_Vector atol, double rtol, Scene *scene)
      : memory(ERKStepCreate(right_side, 0.0, y, context)) {
      check(ERKStepSVtolerances(memory, rtol, atol), "ERKStepSVtolerances");
      check(ERKStepSetTableNum(memory, ARKODE_DORMAND_PRINCE_7_4_5), "ERKStepSetTableNum");
      check(ERKStepSetUserData(memory, scene), "ERKStepSetUserData");
      check(ERKStepRootInit(memory, 4, roots), "ERKStepRootInit");
      check(ERKStepSetRootDirection(memory, directions), "ERKStepSetRootDirection");
      check(ERKStepSetNoInactiveRootWarn(memory), "ERKStepSetNoInactiveRootWarn");
      check(ERKStepSetMaxNumSteps(memory, 1000000), "ERKStepSetMaxNumSteps");
      // Its steps end at the requested output times, and it has an interpolant of order five.
      check(ERKStepSetInterpolantDegree(memory, 5), "ERKStepSetInterpolantDegree");
   }
   void restart(double t, N_Vector y) { check(ERKStepReset(memory, t, y), "ERKStepReset"); }
   void stop_at(double t) { check(ERKStepSetStopTime(memory, t), "ERKStepSetStopTime"); }
   int go(double end, N_Vector y, double *t) { return ERKStepEvolve(memory, end, y, t, ARK_NORMAL); }
   void found(int *which) { check(ERKStepGetRootInfo(memory, which), "ERKStepGetRootInfo"); }
   static constexpr int at_root = ARK_ROOT_RETURN;

 private:
   void *memory;
};

// The solver exists for the lifetime of the program.
template <class Solver>
class Flight {
 public:
   Flight(const Wall &wall, double rtol, bool free) : scene(new Scene{wall, nullptr, 0.0, free}) {
      SUNContext context;
      check(SUNContext_Create(nullptr, &context), "SUNContext_Create");
      y = N_VNew_Serial(2, context);
      N_VConst(0.0, y);
      N_Vector atol = N_VNew_Serial(2, context);
      N_VGetArrayPointer(atol)[0] = 0.01 * rtol * wall.capacity;
      N_VGetArrayPointer(atol)[1] = 0.01 * rtol * wall.capacity * std::sqrt(wall.p2);
      solver.reset(new Solver(context, y, atol, rtol, scene.get()));
   }

   void begin(const Ground &ground, const Motion &m) {
      fresh = true;
      scene->ground = &ground;
      scene->entered = m.interval * ground.record.dt;
      N_VGetArrayPointer(y)[0] = m.now.q;
      N_VGetArrayPointer(y)[1] = m.now.v;
      solver->restart(scene->entered + m.time, y);
   }

   Event fly(Ground &ground, Motion &m) {
      const double dt = ground.record.dt;
      const double end = (scene->free ? ground.last() : m.interval + 1) * dt;
      const double remaining = end - (m.interval * dt + m.time);
      if (fresh && remaining <= 1e-15 * end) {
         // Too short for SUNDIALS to start: advance to the sample, which is exact to rounding.
         m.now.q = std::max(0.0, m.now.q + remaining * m.now.v);
         ++m.interval;
         m.time = 0.0;
         if (m.interval < ground.last()) ground.enter(m.interval);
         begin(ground, m);
         return Event::none;
      }
      fresh = false;
      solver->stop_at(end);
      double t;
      const int flag = solver->go(end, y, &t);
      check(flag, "the integration");
      m.now.q = N_VGetArrayPointer(y)[0];
      m.now.v = N_VGetArrayPointer(y)[1];
      if (flag == Solver::at_root) {
         int which[4];
         solver->found(which);
         if (scene->free) m.interval = std::min(static_cast<int>(t / dt), ground.last() - 1);
         m.time = std::min(t - m.interval * dt, dt);
         return which[0] || which[3] ? Event::impact : which[2] ? Event::limit : Event::peak;
      }
      m.interval = scene->free ? ground.last() : m.interval + 1;
      m.time = 0.0;
      scene->entered = m.interval * dt;
      if (m.interval < ground.last()) ground.enter(m.interval);
      return Event::none;
   }

 private:
   std::unique_ptr<Scene> scene;
   bool fresh = true;  // restarted and not advanced since
   N_Vector y;
   std::unique_ptr<Solver> solver;
};

template <class Solver>
int run_by(int argc, char **argv) {
   return run_peer(argc, argv, "SUNDIALS " SUNDIALS_VERSION, [](const Request &request, const Problem &problem) {
      const bool free = request.method == "adams_free";
      return [&wall = problem.wall, rest = Rest(problem.wall),
              flight = Flight<Solver>(problem.wall, request.setting, free)](const History &history) mutable {
         return simulate(wall, rest, history, flight);
      };
   });
}

}  // namespace

int main(int argc, char **argv) {
   const bool by_arkode = argc > 2 && std::string(argv[2]) == "dopri5";
   return by_arkode ? run_by<ErkStep>(argc, argv) : run_by<Cvode>(argc, argv);
}
