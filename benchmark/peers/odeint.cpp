// Boost.odeint: its Dormand-Prince stepper of order five, by two methods.
// cut: controlled steps that end on every sample; events by steps of adjusted length.
// free: dense output, steps limited only by the error, across samples; events by the interpolant.
// The setting is the relative tolerance.
#include <array>
#include <boost/numeric/odeint.hpp>
#include <boost/version.hpp>

#include "hybrid.hpp"

namespace {

namespace odeint = boost::numeric::odeint;
using Vector = std::array<double, 2>;
using Stepper = odeint::runge_kutta_dopri5<Vector>;

class Cut {
 public:
   Cut(const Wall &wall, double rtol)
      : wall(wall), controlled(odeint::make_controlled(0.01 * rtol * wall.capacity, rtol, Stepper())) {}

   void begin(const Ground &ground, const Motion &) {
      if (!(step > 0.0)) step = ground.record.dt;
   }

   Event fly(Ground &ground, Motion &m) {
      const double dt = ground.record.dt;
      const auto system = [&](const Vector &x, Vector &dxdt, double t) {
         dxdt = {x[1], acceleration(wall, x[0], ground.push(t))};
      };
      for (;;) {
         const Vector x{m.now.q, m.now.v}, dxdt{m.now.v, m.now.f};
         const double remaining = dt - m.time;
         Vector x_new, dxdt_new;
         double t, h, proposal;
         bool whole;
         do {
            whole = step >= remaining;
            h = whole ? remaining : step;
            t = m.time;
            proposal = h;
            if (controlled.try_step(system, x, dxdt, t, x_new, dxdt_new, proposal) == odeint::success) break;
            step = proposal;
         } while (true);
         // A step that was cut at the sample must not shorten the proposal.
         step = whole ? std::max(step, proposal) : proposal;
         const auto after = [&](double length) {
            Vector y, dydt, error;
            stepper.do_step(system, x, dxdt, m.time, y, dydt, length, error);
            return State{y[0], y[1], dydt[1]};
         };
         State to{x_new[0], x_new[1], dxdt_new[1]};
         const Event event = find_event(wall, after, m.now, m.peak, to, h);
         m.now = to;
         if (event != Event::none) {
            m.now.f = acceleration(wall, to.q, ground.push(m.time + h));
            m.time = std::min(m.time + h, dt);
            if (event != Event::peak) return event;
            m.peak = to.q;
         } else if (whole) {
            m.time = 0.0;
            if (++m.interval < ground.last()) ground.enter(m.interval);
            return event;
         } else {
            m.time += h;
         }
      }
   }

 private:
   const Wall &wall;
   decltype(odeint::make_controlled(0.0, 0.0, Stepper())) controlled;
   Stepper stepper;
   double step = 0.0;
};

class Free {
 public:
   Free(const Wall &wall, double rtol)
      : wall(wall), dense(odeint::make_dense_output(0.01 * rtol * wall.capacity, rtol, Stepper())) {}

   void begin(const Ground &ground, const Motion &m) {
      dense.initialize(Vector{m.now.q, m.now.v}, m.interval * ground.record.dt + m.time, ground.record.dt);
   }

   Event fly(Ground &ground, Motion &m) {
      const double dt = ground.record.dt, end = ground.last() * dt;
      const auto push = [&](double t) {
         const double x = t / dt;
         const int i = std::min(static_cast<int>(x), ground.last() - 1);
         const double here = ground.sample(i);
         return ground.side * (here + (ground.sample(i + 1) - here) * (x - i));
      };
      const auto system = [&](const Vector &x, Vector &dxdt, double t) {
         dxdt = {x[1], acceleration(wall, x[0], push(t))};
      };
      State from = m.now;
      for (;;) {
         auto [t, t_new] = dense.do_step(system);
         double h = std::min(t_new, end) - t;
         const auto after = [&, t = t](double length) {
            Vector y;
            dense.calc_state(t + length, y);
            return State{y[0], y[1], acceleration(wall, y[0], push(t + length))};
         };
         const bool over = t_new >= end;
         State to = after(h);
         const Event event = find_event(wall, after, from, m.peak, to, h);
         if (event == Event::peak) {
            // The step continues after the peak.
            m.peak = to.q;
            h = std::min(t_new, end) - t;
            from = to;
            to = after(h);
            const Event next = to.q > 0.0 ? Event::none : find_event(wall, after, from, m.peak, to, h);
            if (next != Event::none) return land(ground, m, next, to, t + h);
         } else if (event != Event::none) {
            return land(ground, m, event, to, t + h);
         }
         from = to;
         m.peak = std::max(m.peak, to.q);
         if (over) {
            m.now = to;
            m.interval = ground.last();
            return Event::none;
         }
      }
   }

 private:
   Event land(Ground &ground, Motion &m, Event event, const State &to, double t) {
      const double dt = ground.record.dt;
      m.now = to;
      m.interval = std::min(static_cast<int>(t / dt), ground.last() - 1);
      m.time = t - m.interval * dt;
      return event;
   }

   const Wall &wall;
   decltype(odeint::make_dense_output(0.0, 0.0, Stepper())) dense;
};

template <class Flight>
auto runner(const Request &request, const Problem &problem) {
   return [&wall = problem.wall, rest = Rest(problem.wall), flight = Flight(problem.wall, request.setting)](
             const History &history) mutable { return simulate(wall, rest, history, flight); };
}

}  // namespace

int main(int argc, char **argv) {
   const auto version = "Boost " BOOST_LIB_VERSION;
   const bool cut = argc > 2 && std::string(argv[2]) == "cut";
   return cut ? run_peer(argc, argv, version, runner<Cut>) : run_peer(argc, argv, version, runner<Free>);
}
