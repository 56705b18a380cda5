// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_pressure_virtual_faces_h
#define undine_particles_pressure_virtual_faces_h

#include <undine/particles/fluid/stored_correction.h>
#include <undine/particles/math/matrix.h>
#include <undine/particles/model/constants.h>
#include <undine/particles/model/step_control.h>
#include <undine/particles/neighbours/neighbours.h>

namespace undine::particles
{
  /// The virtual face between two particles i and j, as its area vector (out of i) over twice
  /// the volume of a particle [1/m]:
  ///     a_ij = (dim / n0) (w / r^2) (M_i + M_j) / 2 r_ij + k_ij (L_i - L_j),   a_ij = -a_ji.
  /// The potentials L [1/m] are such that the faces of each covered particle close, sum_j a_ij = 0,
  /// as those of cells do [Trask, Bochev, Perego 2020]. The divergence of velocities and the forces
  /// of pressures use the same faces, so that they exchange the same work; forces are equal and
  /// opposite whatever L is, and with closed faces a constant pressure exerts none.
  template <int dim, class Real>
  struct VirtualFaces
  {
    Real                               factor;      ///< dim / n0
    const StoredCorrection<dim, Real> *corrections; ///< M
    const StoredVector<dim, Real>     *potentials;  ///< L; nullptr: faces are not used. With what
                                                    ///< TakePressures tells of the free surface

    /// What a particle contributes to its faces.
    struct Side
    {
      StoredCorrection<dim, Real> M;
      StoredVector<dim, Real>     L;

      /// Zero where the pressure is given.
      UNDINE_HOST_DEVICE
      Vector<dim, Real>
      potential() const
      {
        return M.has_unknown() ? Vector<dim, Real>(L) : Vector<dim, Real>::zero();
      }

      /// How much it is fluid at the free surface [1].
      UNDINE_HOST_DEVICE
      Real
      surface() const
      {
        return L.companion();
      }
    };

    UNDINE_HOST_DEVICE
    Side
    side(const int i) const
    {
      if (potentials == nullptr)
        return {StoredCorrection<dim, Real>::of(SymmetricMatrix<dim, Real>::diagonal(1),
                                                PressureIs::given),
                {}};
      return {corrections[i], potentials[i]};
    }

    /// The part without potentials.
    UNDINE_HOST_DEVICE
    Vector<dim, Real>
    open(const SymmetricMatrix<dim, Real> &M_i,
         const SymmetricMatrix<dim, Real> &M_j,
         const Pair<dim, Real>            &pair) const
    {
      return (factor / 2 * pair.weight_over_square()) * (M_i * pair.r + M_j * pair.r);
    }

    /// `k` is the pair's coefficient in the pressure equation.
    UNDINE_HOST_DEVICE
    Vector<dim, Real>
    closed(const Side &i, const Side &j, const Real k, const Pair<dim, Real> &pair) const
    {
      return open(i.M.matrix(), j.M.matrix(), pair) + k * (i.potential() - j.potential());
    }
  };
} // namespace undine::particles

#endif
