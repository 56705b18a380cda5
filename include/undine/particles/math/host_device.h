// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_math_host_device_h
#define undine_particles_math_host_device_h

/// Marks functions that run on the host and, where nvcc compiles them, on the device.
#ifdef __CUDACC__
#  define UNDINE_HOST_DEVICE __host__ __device__ __forceinline__
#else
#  define UNDINE_HOST_DEVICE inline
#endif

/// Before a loop of few rounds: writes them out one after the other.
#ifdef __CUDA_ARCH__
#  define UNDINE_UNROLL _Pragma("unroll")
#  define UNDINE_UNROLL_ALL _Pragma("unroll")
#else
#  define UNDINE_UNROLL _Pragma("GCC unroll 8")
#  define UNDINE_UNROLL_ALL _Pragma("GCC unroll 27")
#endif

#endif
