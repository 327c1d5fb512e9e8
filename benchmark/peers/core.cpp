// How much of its core a program has. Processors that run two threads on a core share its units between them: a chain of
// multiplications, each of which waits for the one before, takes as long as alone, independent additions take up to twice
// as long. The other thread may belong to another machine of the same host, which nothing else shows.
// Usage: core
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>

namespace {

using Clock = std::chrono::steady_clock;
constexpr int multiplications = 400'000, parts = 5, additions = 20'000'000;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// Seconds of one multiplication; interruptions lengthen it, so that the least of several counts
double multiplication() {
   double least = 1.0;
   std::uint64_t x = 3;
   for (int part = 0; part < parts; ++part) {
      const auto start = Clock::now();
      for (int i = 0; i < multiplications; ++i) {
         x *= x;
         asm volatile("" : "+r"(x));
      }
      least = std::min(least, seconds_since(start) / multiplications);
   }
   return least;
}

// Seconds of one of eight independent additions
double addition() {
   std::uint64_t a = 1, b = 2, c = 3, d = 4, e = 5, f = 6, g = 7, h = 8;
   const auto start = Clock::now();
   for (int i = 0; i < additions; ++i) {
      ++a, ++b, ++c, ++d, ++e, ++f, ++g, ++h;
      asm volatile("" : "+r"(a), "+r"(b), "+r"(c), "+r"(d), "+r"(e), "+r"(f), "+r"(g), "+r"(h));
   }
   return seconds_since(start) / (8.0 * additions);
}

}  // namespace

int main() {
   const double multiplied = multiplication(), added = addition();
   std::printf("multiplication %.6e\naddition %.6e\n", multiplied, added);
}
