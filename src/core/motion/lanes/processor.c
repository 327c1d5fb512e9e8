/* What the processor can do, and the system lets programs use. Fortran cannot ask. */

/* 3: AVX-512, as meson.build has it; 2: AVX2 and fused multiply-add; 1: neither, or the build has no use for them */
int dondolo_processor_level(void)
{
#ifdef DONDOLO_VARIANTS
   __builtin_cpu_init();
   if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
      if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
          __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
          __builtin_cpu_supports("avx512vl"))
         return 3;
      return 2;
   }
#endif
   return 1;
}
