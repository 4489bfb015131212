// SPDX-License-Identifier: MIT
#pragma once

/// The version of the library, as its numbers and as text.
#define TAMIAS_VERSION_MAJOR 0
#define TAMIAS_VERSION_MINOR 1
#define TAMIAS_VERSION_PATCH 0
#define TAMIAS_VERSION "0.1.0"

// One precision per translation unit. CMake targets choose it: `tamias2d` is float, `tamias2d_f64`
// defines TAMIAS_F64. Each precision has its own inline namespace, so one program can link both [ADR2].
#if defined(TAMIAS_F64)
#define TAMIAS_PRECISION f64
#else
#define TAMIAS_PRECISION f32
#endif

// The core builds with and without exceptions; this says which of the two this translation unit is.
#if defined(__cpp_exceptions) || defined(__EXCEPTIONS) || defined(_CPPUNWIND)
#define TAMIAS_HAS_EXCEPTIONS 1
#else
#define TAMIAS_HAS_EXCEPTIONS 0
#endif

// Has this build threads of its own? WebAssembly without shared memory has none.
#if defined(__wasm__) && !defined(__wasm_atomics__)
#define TAMIAS_HAS_THREADS 0
#else
#define TAMIAS_HAS_THREADS 1
#endif

namespace tamias2d::inline TAMIAS_PRECISION {

/// The scalar of vectors, masses and velocities. Places are always double (Position) [ADR3].
#if defined(TAMIAS_F64)
using real = double;
#else
using real = float;
#endif

}  // namespace tamias2d::inline TAMIAS_PRECISION
