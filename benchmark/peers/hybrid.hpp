// The hybrid motion of theory.md, section 4: rest, rocking, impacts, the end of a chain of bounces, the motion after the
// record. A peer adds a Flight, which integrates the rocking between two impacts.
#pragma once

#include <cmath>

#include "problem.hpp"

// The ground acceleration in the sense of the active side, in units of g
struct Ground {
   const Record &record;
   double scale;
   double side = 1.0;
   double start = 0.0, slope = 0.0;  // of the interval entered last

   int last() const { return static_cast<int>(record.a.size()) - 1; }
   double sample(int i) const { return scale * record.a[i]; }

   void enter(int interval) {
      start = side * sample(interval);
      slope = side * (sample(interval + 1) - sample(interval)) / record.dt;
   }
   double push(double time) const { return start + slope * time; }
};

inline double acceleration(const Wall &wall, double q, double push) {
   return -wall.p2 * (std::sin(wall.capacity - q) + push * std::cos(wall.capacity - q));
}

struct State {
   double q, v, f;  // rotation, velocity, acceleration
};

struct Motion {
   int interval = 0;   // sample before the present instant
   double time = 0.0;  // since that sample
   State now{0.0, 0.0, 0.0};
   double peak = 0.0;
   int impacts = 0;
   int tiny_bounces = 0;  // consecutive
};

enum class Event { none, impact, peak, limit };

// Flights shorter than this part of a sample interval are rounding
constexpr double shortest = 2.2e-13;

// Number of consecutive bounces treated as rest, and their height in still ground as a part of q_c
constexpr int most_tiny_bounces = 1000;
constexpr double tiny_height = 1e-12;

// The wall at rest, and the conditions under which it returns to rest
class Rest {
 public:
   explicit Rest(const Wall &wall) : wall(wall), trigger(std::tan(wall.capacity)) {
      moment = wall.p2 * std::sin(wall.capacity);
      lever = wall.p2 * std::cos(wall.capacity);
      for (height = 1e-3 * wall.capacity;; height *= 0.5) {
         slack = std::fabs(std::sin(wall.capacity - height) / std::sin(wall.capacity) - 1.0) +
                 std::fabs(std::cos(wall.capacity - height) / std::cos(wall.capacity) - 1.0);
         if (slack <= 4e-3) break;
      }
   }

   // Advance to the start of rocking, in closed form within its interval; false if there is none
   bool next_start(Ground &ground, Motion &m) const {
      if (m.interval >= ground.last()) return false;
      const double dt = ground.record.dt;
      double here = ground.sample(m.interval);
      here += (ground.sample(m.interval + 1) - here) * (m.time / dt);
      for (;;) {
         const double next = ground.sample(m.interval + 1);
         const bool already = opens(here);
         if (already || opens(next)) {
            ground.side = (already ? here : next) > 0.0 ? -1.0 : 1.0;
            if (!already) m.time += (dt - m.time) * ((-ground.side * trigger - here) / (next - here));
            return true;
         }
         if (++m.interval == ground.last()) return false;
         m.time = 0.0;
         here = next;
      }
   }

   // Whether the chain of bounces after an impact provably ends at rest
   bool chain_ends(const Ground &ground, const Motion &m) const {
      const double dt = ground.record.dt, e = wall.restitution, w = m.now.v;
      const int last = ground.last();
      double growth = 1.0, elapsed = -m.time;
      double push = ground.sample(m.interval);
      if (m.interval < last) push += (ground.sample(m.interval + 1) - push) * (m.time / dt);
      Moments from = least_moments(ground.side * push), least = from;
      for (int i = m.interval;; ++i) {
         const Moments to = least_moments(i < last ? ground.side * ground.sample(i + 1) : 0.0);
         least = {std::min(least.active, to.active), std::min(least.other, to.other)};
         const double smallest = std::min(least.active, least.other);
         if (!(smallest > 0.0)) return false;
         growth *= std::max({1.0, to.active / from.active, to.other / from.other});
         const double rise = 0.5 * w * w * 1.03 * growth / smallest;
         if (rise > std::min(height, m.peak) || growth > 10.0) return false;
         const double duration =
            2.0 * w * std::sqrt(1.03 * growth) * (1.0 / least.active + e / least.other) / (1.0 - e * e);
         elapsed += dt;
         if (duration <= elapsed || i >= last) return true;
         from = to;
      }
   }

   // Whether the wall is at rest after an impact
   bool ends(const Ground &ground, Motion &m) const {
      const bool tiny = 0.5 * m.now.v * m.now.v < tiny_height * wall.capacity * moment;
      m.tiny_bounces = tiny ? m.tiny_bounces + 1 : 0;
      if (m.now.v == 0.0 || m.tiny_bounces > most_tiny_bounces) return true;
      const double inward = -m.now.f;
      if (!(inward > 0.0)) return false;
      return 2.0 * m.now.v / inward <= shortest * ground.record.dt || chain_ends(ground, m);
   }

 private:
   struct Moments {
      double active, other;
   };

   bool opens(double a) const { return -a > trigger || (wall.two_sided && a > trigger); }

   Moments least_moments(double push) const {
      const double active = (1.0 - slack) * moment + lever * push - slack * lever * std::fabs(push);
      return {active, wall.two_sided ? active - 2.0 * lever * push : active};
   }

   const Wall &wall;
   double trigger, moment, lever, height, slack;
};

// Peak of the motion after the record from its energy; the capacity for a collapse
inline double peak_after(const Wall &wall, const State &end) {
   const double rest = wall.p2 * std::cos(wall.capacity);
   double energy = 0.5 * end.v * end.v + wall.p2 * std::cos(wall.capacity - end.q);
   if (!(end.v > 0.0)) energy = rest + wall.restitution * wall.restitution * (energy - rest);
   if (energy >= wall.p2) return wall.capacity;
   return wall.capacity - std::acos(energy / wall.p2);
}

// One history. A Flight has begin(ground, motion), called at the start of rocking and after each impact, and
// fly(ground, motion), which advances to the next event or to a sample, at most to the last one.
template <class Flight>
Outcome simulate(const Wall &wall, const Rest &rest, const History &history, Flight &flight) {
   Ground ground{*history.record, history.scale};
   const double dt = ground.record.dt;
   Motion m;
   while (rest.next_start(ground, m)) {
      const int first = m.interval;
      const double start = m.time;
      m.tiny_bounces = 0;
      ground.enter(m.interval);
      m.now = {0.0, 0.0, std::max(0.0, acceleration(wall, 0.0, ground.push(m.time)))};
      flight.begin(ground, m);
      for (bool rocking = true; rocking;) {
         if (m.interval == ground.last()) {
            m.peak = std::max(m.peak, peak_after(wall, m.now));
            return {m.peak / wall.capacity, m.peak >= wall.capacity, m.impacts};
         }
         const Event event = flight.fly(ground, m);
         m.peak = std::max(m.peak, m.now.q);
         if (event == Event::limit) return {1.0, true, m.impacts};
         if (event == Event::impact) {
            ++m.impacts;
            if (wall.two_sided) ground.side = -ground.side;
            if (m.interval < ground.last()) ground.enter(m.interval);
            const double speed = wall.restitution * std::max(0.0, -m.now.v);
            m.now = {0.0, speed, acceleration(wall, 0.0, ground.push(m.time))};
            rocking = !rest.ends(ground, m);
            if (rocking) flight.begin(ground, m);
         }
      }
      // A start exactly at the threshold that rounding undoes at once is not repeated.
      if (m.interval == first && m.time - start <= shortest * dt) {
         ++m.interval;
         m.time = 0.0;
      }
   }
   return {m.peak / wall.capacity, false, m.impacts};
}

// Root within (0, h] of a gap that is positive at the start, by Newton's method in a bracket.
// after(x) returns the state after x, gap(state) the gap and its rate.
template <class After, class Gap>
State find_root(const After &after, const Gap &gap, double &h) {
   double low = 0.0, high = h, x = h;
   State state{};
   for (int i = 0; i < 60; ++i) {
      state = after(x);
      const auto [value, rate] = gap(state);
      (value > 0.0 ? low : high) = x;
      if (value == 0.0 || high - low <= 4e-16 * high) break;
      const double change = rate < 0.0 ? -value / rate : 0.0;
      if (rate < 0.0 && std::fabs(change) <= 1e-8 * x) {
         // The last Newton step needs no evaluation: its error is the square of the change.
         state.q += change * (state.v + 0.5 * change * state.f);
         state.v += change * state.f;
         x += change;
         break;
      }
      x += change;
      if (!(x > low && x < high)) x = 0.5 * (low + high);
   }
   h = x;
   return state;
}

// First event in a step of length h from one state to another; the step is shortened to it.
template <class After>
Event find_event(const Wall &wall, const After &after, const State &from, double peak, State &to, double &h) {
   const auto falls = [](const State &s) { return std::pair(s.q, s.v); };
   const auto turns_in = [](const State &s) { return std::pair(s.v, s.f); };
   const auto turns_out = [](const State &s) { return std::pair(-s.v, -s.f); };
   const auto reaches = [&](const State &s) { return std::pair(wall.capacity - s.q, -s.v); };
   // Outwards and back within the step: a new peak, if possible, comes first.
   if (from.v > 0.0 && to.v < 0.0 && std::max(from.q + h * from.v, to.q - h * to.v) > peak) {
      double x = h;
      const State top = find_root(after, turns_in, x);
      if (top.q > peak || top.q >= wall.capacity) {
         h = x;
         to = top;
         to.v = 0.0;
         if (top.q < wall.capacity) return Event::peak;
         to = find_root(after, reaches, h);
         return Event::limit;
      }
   }
   if (to.q >= wall.capacity) {
      to = find_root(after, reaches, h);
      return Event::limit;
   }
   if (from.q > 0.0 && from.v < 0.0 && to.v > 0.0 && to.q > 0.0) {
      // Inwards and out again: check for a dip below zero in between.
      if (std::min(from.q + h * from.v, to.q - h * to.v) > 0.0) return Event::none;
      double x = h;
      if (find_root(after, turns_out, x).q > 0.0) return Event::none;
      h = x;
   } else if (to.q > 0.0 || (to.q == 0.0 && to.v > 0.0)) {
      return Event::none;
   }
   to = find_root(after, falls, h);
   to.q = 0.0;
   return Event::impact;
}
