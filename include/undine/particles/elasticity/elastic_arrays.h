// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_elasticity_elastic_arrays_h
#define undine_particles_elasticity_elastic_arrays_h

#include <undine/particles/elasticity/elastic_bodies.h>
#include <undine/particles/elasticity/implicit_elasticity.h>
#include <undine/particles/elasticity/reference_lattice.h>
#include <undine/particles/execution/buffer.h>

namespace undine::particles
{
  /// The memory of ElasticBodies and of what their steps need.
  template <class Executor, int dim, class Real>
  struct ElasticArrays
  {
    using Vectors  = Buffer<Executor, Vector<dim, Real>>;
    using Matrices = Buffer<Executor, Matrix<dim, Real>>;

    ElasticArrays(const Executor                    &executor,
                  const ReferenceLattice<dim, Real> &lattice,
                  const int                          partner_capacity)
      : n(static_cast<int>(lattice.points.size()))
      , capacity(lattice.capacity)
      , reference(executor, lattice.points)
      , bodies(executor, lattice.bodies)
      , materials(executor, lattice.materials)
      , members(executor, lattice.members)
      , starts(executor, lattice.starts)
      , clamped(executor, lattice.clamped)
      , held(executor, lattice.held)
      , inside(executor, lattice.inside)
      , counts(executor, lattice.counts)
      , indices(executor, lattice.indices)
      , inverse_moments(executor, lattice.inverse_moments)
      , points(executor, n)
      , rotations(executor, std::vector<Matrix<dim, Real>>(n, Matrix<dim, Real>::diagonal(1)))
      , carried(executor, lattice.materials.size())
      , deformations(executor, n)
      , tractions(executor, n)
      , points_next(executor, n)
      , partner_counts(executor, n)
      , partners(executor, list_slot((n + 31) / 32 * 32, 0, partner_capacity))
      , x_start(executor, n)
      , v_start(executor, n)
      , accelerations(executor, n)
      , where(executor, n)
      , implicit_work(executor, 4 * n)
      , implicit_tensors(executor, 2 * n)
      , rigid(executor, lattice.materials.size())
    {
    }

    ElasticBodies<dim, Real>
    view() const
    {
      return {n,
              reference.data(),
              bodies.data(),
              materials.data(),
              static_cast<int>(materials.size()),
              members.data(),
              starts.data(),
              clamped.data(),
              held.data(),
              capacity,
              counts.data(),
              indices.data(),
              inverse_moments.data(),
              points.data(),
              deformations.data(),
              rotations.data(),
              tractions.data(),
              carried.data()};
    }

    ImplicitVectors<dim, Real>
    implicit_vectors() const
    {
      Vector<dim, Real> *const w = implicit_work.data();
      return {w,
              w + n,
              w + 2 * n,
              w + 3 * n,
              implicit_tensors.data(),
              implicit_tensors.data() + n,
              rigid.data()};
    }

    int n, capacity;

    /// Constant. @{
    Buffer<Executor, ReferencePoint<dim, Real>> reference;
    Buffer<Executor, int>                       bodies;
    Buffer<Executor, ElasticMaterial<Real>>     materials;
    Buffer<Executor, int>                       members, starts; ///< of ElasticBodies
    Buffer<Executor, unsigned char>             clamped, held;   ///< of ElasticBodies
    Buffer<Executor, unsigned char>             inside;          ///< surrounded by their own body
    Buffer<Executor, int>                       counts, indices;
    Matrices                                    inverse_moments;
    /// @}

    /// The state. @{
    Buffer<Executor, ElasticPoint<dim, Real>> points;
    Matrices                                  rotations;
    Buffer<Executor, Real>                    carried;
    /// @}

    /// Of a sub-step. @{
    Matrices                                  deformations;
    Buffer<Executor, Traction<dim, Real>>     tractions;
    Buffer<Executor, ElasticPoint<dim, Real>> points_next;
    Buffer<Executor, int>                     partner_counts, partners; ///< of Contact
    Vectors                                   x_start, v_start;
    Vectors                                   accelerations; ///< by pressures [m/s^2]
    Buffer<Executor, int>                     where;         ///< sorted place of each identity
    Vectors                                   implicit_work; ///< of ImplicitVectors
    Matrices                                  implicit_tensors;
    Buffer<Executor, RigidMotion<dim, Real>>  rigid;
    /// @}
  };
} // namespace undine::particles

#endif
