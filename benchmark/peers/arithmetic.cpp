// What the processor can do on one core: as many fused multiplications and additions as 3.24e6 steps of 90, in independent
// chains of its widest vectors. No history is computed: the time is a limit to hold those of the programs against.
// Usage: arithmetic REPEATS
#include <chrono>
#include <cstdio>
#include <cstdlib>

#if defined(__AVX512F__)
constexpr int width = 8;
#elif defined(__AVX__)
constexpr int width = 4;
#else
constexpr int width = 2;
#endif
typedef double Vector __attribute__((vector_size(width * sizeof(double))));

int main(int argc, char **argv) {
   constexpr int chains = 12;  // as many as hide the latency of two a cycle, and fit the registers
   constexpr double operations = 3.24e6 * 90.0;
   const int repeats = argc > 1 ? std::atoi(argv[1]) : 1;
   const long rounds = static_cast<long>(operations / (width * chains));
   // The values tend to 500
   const Vector factor = Vector{} + 0.999, term = Vector{} + 0.5;
   Vector x[chains];
   for (Vector &each : x) each = Vector{} + 1.0;
   for (int repeat = 0; repeat < repeats; ++repeat) {
      const auto start = std::chrono::steady_clock::now();
      for (long i = 0; i < rounds; ++i)
         for (Vector &each : x) each = each * factor + term;
      const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
      std::printf("seconds %.9f\n", seconds.count());
   }
   double sum = 0.0;
   for (const Vector &each : x) sum += each[0];
   return sum > 0.0 ? 0 : 1;
}
