// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_elastic_arrays_h
#define undine_particles_elastic_arrays_h

#include <undine/particles/buffer.h>
#include <undine/particles/elastic_bodies.h>
#include <undine/particles/implicit_elasticity.h>
#include <undine/particles/reference_lattice.h>

namespace undine::particles
{
  /// The memory of ElasticBodies and of what their steps need.
  template <class Executor, int dim, class Real>
  struct ElasticArrays
  {
    using Vectors  = Buffer<Executor, Vector<dim, Real>>;
    using Matrices = Buffer<Executor, Matrix<dim, Real>>;

    ElasticArrays(const Executor &executor, const ReferenceLattice<dim, Real> &lattice)
      : n(static_cast<int>(lattice.positions.size()))
      , capacity(lattice.capacity)
      , reference(executor, lattice.positions)
      , bodies(executor, lattice.bodies)
      , materials(executor, lattice.materials)
      , held(executor, lattice.held)
      , inside(executor, lattice.inside)
      , counts(executor, lattice.counts)
      , indices(executor, lattice.indices)
      , inverse_moments(executor, lattice.inverse_moments)
      , inverse_means(executor, lattice.inverse_means)
      , x(executor, lattice.positions)
      , v(executor, n)
      , rotations(executor, std::vector<Matrix<dim, Real>>(n, Matrix<dim, Real>::diagonal(1)))
      , carried(executor, lattice.materials.size())
      , surfaces(executor, n)
      , surface_moments(executor, n)
      , deformations(executor, n)
      , stresses(executor, n)
      , x_next(executor, n)
      , v_next(executor, n)
      , x_start(executor, n)
      , v_start(executor, n)
      , accelerations(executor, n)
      , where(executor, n)
      , implicit_work(executor, 4 * n)
      , implicit_tensors(executor, 2 * n)
    {
    }

    ElasticBodies<dim, Real>
    view() const
    {
      return {n,
              reference.data(),
              bodies.data(),
              materials.data(),
              held.data(),
              capacity,
              counts.data(),
              indices.data(),
              inverse_moments.data(),
              inverse_means.data(),
              x.data(),
              v.data(),
              deformations.data(),
              rotations.data(),
              stresses.data(),
              carried.data(),
              surfaces.data(),
              surface_moments.data()};
    }

    ImplicitVectors<dim, Real>
    implicit_vectors() const
    {
      Vector<dim, Real> *const w = implicit_work.data();
      return {w, w + n, w + 2 * n, w + 3 * n, implicit_tensors.data(), implicit_tensors.data() + n};
    }

    int n, capacity;

    /// Constant. @{
    Vectors                                 reference;
    Buffer<Executor, int>                   bodies;
    Buffer<Executor, ElasticMaterial<Real>> materials;
    Buffer<Executor, unsigned char>         held;
    Buffer<Executor, unsigned char>         inside; ///< surrounded by their own body
    Buffer<Executor, int>                   counts, indices;
    Matrices                                inverse_moments;
    Buffer<Executor, Real>                  inverse_means;
    /// @}

    /// The state. @{
    Vectors                x, v;
    Matrices               rotations;
    Buffer<Executor, Real> carried;
    Vectors                surfaces;
    Matrices               surface_moments;
    /// @}

    /// Of a sub-step. @{
    Matrices              deformations, stresses;
    Vectors               x_next, v_next, x_start, v_start;
    Vectors               accelerations; ///< by pressures [m/s^2]
    Buffer<Executor, int> where;         ///< sorted place of each identity
    Vectors               implicit_work; ///< of ImplicitVectors
    Matrices              implicit_tensors;
    /// @}
  };
} // namespace undine::particles

#endif
