// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_elasticity_reference_lattice_h
#define undine_particles_elasticity_reference_lattice_h

#include <undine/particles/elasticity/elastic_bodies.h>
#include <undine/particles/setup/setup.h>

#include <vector>

namespace undine::particles
{
  /// What never changes of the elastic bodies, by identity; computed on the host once.
  template <int dim, class Real>
  struct ReferenceLattice
  {
    explicit ReferenceLattice(const Setup<dim> &setup);

    std::vector<ReferencePoint<dim, Real>> points;
    std::vector<int>                       bodies;
    std::vector<ElasticMaterial<Real>>     materials;
    std::vector<int>                       members, starts; ///< of ElasticBodies
    std::vector<unsigned char>             clamped, held;   ///< of ElasticBodies
    std::vector<unsigned char>     inside; ///< has nearly as many neighbours as in a full lattice
    int                            capacity;
    std::vector<int>               counts, indices;
    std::vector<Matrix<dim, Real>> inverse_moments;

    /// As in StepBounds, of the body that needs the shortest explicit steps [1/s]; 0 without
    /// bodies.
    double
    rate() const;

  private:
    void
    find_neighbours(double reach, const std::vector<Vector<dim, double>> &reference);

    double spacing;
  };
} // namespace undine::particles

#endif
