#!/bin/bash
# Builds dondolo-gpu, histories on a graphics processor (docs/studies/gpu.md): bash benchmark/gpu/build.sh LIBRARY TARGET [FLAG...]
# LIBRARY is the build folder of the library, TARGET the folder that gets the program, and FLAGs tell gfortran what to offload
# to; -foffload=disable leaves the histories on the processor.
set -euo pipefail
sources=$(cd "$(dirname "$0")" && pwd)
lanes=$(cd "$sources/../../src/dondolo/motion/lanes" && pwd)
library=$(cd "$1" && pwd)
target=$2
offload=("${@:3}")
[ ${#offload[@]} -gt 0 ] ||
   offload=(-foffload=nvptx-none -foffload-options=nvptx-none=-O3 -foffload-options=nvptx-none=-lm)
mkdir -p "$target"
cd "$target"

flags=(-O3 -std=f2018 -ffp-contract=fast -fno-trapping-math -fno-math-errno)
for folder in src/libdondolo.a.p src/libdondolo_core.a.p src/dondolo/motion/lanes/libdondolo_lanes.a.p; do
   flags+=(-I "$library/$folder")
done
device=("${flags[@]}" -fopenacc "${offload[@]}")

for source in gpu_state gpu_ground gpu_events; do
   gfortran "${device[@]}" -c "$sources/$source.f90"
done
# One kernel for each kind of normal form, by the names that lane_kernel.F90 has for them
for kind in step_harmonic_10 step_harmonic_16 step_13 step_15; do
   names=(-Ddondolo_gpu_kernel="dondolo_gpu_$kind" -DLANE_KIND="${kind%_*}_" -DLANE_DEGREE="${kind##*_}" -DGPU_STEP="$kind")
   [[ $kind != *harmonic* ]] || names+=(-DLANE_HARMONIC)
   gfortran -E "${names[@]}" -I "$lanes" "$sources/gpu_kernel.F90" -o "gpu_$kind.f90"
   gfortran "${device[@]}" -c "gpu_$kind.f90"
done
gfortran "${flags[@]}" -fopenmp -c "$sources/gpu_walls.f90"
gfortran "${device[@]}" -fopenmp -c "$sources/main.f90"
mapfile -t archives < <(find "$library/src" -name 'libdondolo*.a')
gfortran -O3 -no-pie -fopenmp -fopenacc "${offload[@]}" ./*.o -Wl,--start-group "${archives[@]}" -Wl,--end-group -llapack -lblas \
   -o dondolo-gpu
