// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_adaptivity_sample_norms_h
#define undine_coupled_adaptivity_sample_norms_h

#include <undine/coupled/model/models.h>
#include <undine/coupled/state/state.h>

#include <vector>

namespace undine
{
  /// The sizes of samples and of their derivatives in time: root mean squares, of bodies over their
  /// mass, of a fluid over the volume of the faces that no body cuts. Results are collective.
  template <int dim>
  class SampleNorms
  {
  public:
    using Vector = typename StepHistory<dim>::Vector;
    using Sample = typename StepHistory<dim>::Sample;

    /// `models` must outlive it. Collective.
    explicit SampleNorms(const Models<dim> &models);

    /// The root mean square of a nodal vector, in its unit.
    double
    of_bodies(const Vector &vector) const;

    /// The root mean square of a fluid's velocity [m/s].
    double
    of_fluid(const Velocity<dim> &velocity) const;

    /// The root mean square of the difference of two velocities, over the volume of the faces that
    /// no body cuts in either [m/s].
    double
    of_change(const Velocity<dim> &before, const Velocity<dim> &after) const;

    /// The root mean square of d^k u / dt^k, from k + 1 samples [m/s^(k+1)].
    double
    bodies_derivative(const std::vector<const Sample *> &samples) const;

    /// The root mean square of d^k v / dt^k, from the k + 1 newest samples of a history, k = order
    /// [m/s^(k+1)].
    double
    fluid_derivative(const StepHistory<dim> &history, unsigned int order) const;

    /// The longest side of the box around all bodies at rest [m].
    double
    extent_of_bodies() const;

    /// The velocities of a state at `time` [s].
    Sample
    sample(const State<dim> &state, double time) const;

    /// A velocity that is zero on all faces; empty without a fluid.
    Velocity<dim>
    zero_velocity() const;

    /// Update `uncut`, the number of samples in a row in which no body has cut a face, by the
    /// sample `velocity`.
    void
    count_uncut(Velocity<dim> &uncut, const Velocity<dim> &velocity) const;

  private:
    template <class Value>
    double
    root_mean_square(const Velocity<dim> &velocity, const Value &value) const;

    const Models<dim>               &models;
    typename SolidModel<dim>::Matrix mass;
    double                           total_mass = 0; ///< [kg]
  };
} // namespace undine

#endif
