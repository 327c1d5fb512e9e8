// A hand-written program: one or several Nystrom steps of order four from sample to sample.
// The setting is the number of steps per sample.
#include "hybrid.hpp"

namespace {

class Nystrom {
 public:
   Nystrom(const Wall &wall, int steps) : wall(wall), steps(steps) {}

   void begin(const Ground &, const Motion &) {}

   Event fly(Ground &ground, Motion &m) {
      const double dt = ground.record.dt;
      for (;;) {
         const double remaining = dt - m.time;
         const int parts = std::max(1, static_cast<int>(std::ceil(steps * remaining / dt - 1e-9)));
         double h = remaining / parts;
         const auto after = [&](double x) { return step(ground, m.time, m.now, x); };
         State to = after(h);
         const Event event = find_event(wall, after, m.now, m.peak, to, h);
         m.now = to;
         if (event != Event::none) {
            m.time = std::min(m.time + h, dt);
            if (event != Event::peak) return event;
            m.peak = to.q;
         } else if (parts > 1) {
            m.time += h;
         } else {
            m.time = 0.0;
            if (++m.interval < ground.last()) ground.enter(m.interval);
            return event;
         }
      }
   }

 private:
   // Nystrom (1925), three evaluations, the last of which is reused as the first of the next step
   State step(const Ground &ground, double t, const State &s, double h) const {
      const double middle = acceleration(wall, s.q + 0.5 * h * (s.v + 0.25 * h * s.f), ground.push(t + 0.5 * h));
      const double push = ground.push(t + h);
      const double end = acceleration(wall, s.q + h * (s.v + 0.5 * h * middle), push);
      State to;
      to.q = s.q + h * (s.v + h / 6.0 * (s.f + 2.0 * middle));
      to.v = s.v + h / 6.0 * (s.f + 4.0 * middle + end);
      to.f = acceleration(wall, to.q, push);
      return to;
   }

   const Wall &wall;
   int steps;
};

}  // namespace

int main(int argc, char **argv) {
   return run_peer(argc, argv, "g++ " __VERSION__, [](const Request &request, const Problem &problem) {
      return [&wall = problem.wall, rest = Rest(problem.wall),
              flight = Nystrom(problem.wall, static_cast<int>(request.setting))](const History &history) mutable {
         return simulate(wall, rest, history, flight);
      };
   });
}
