// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/coupled/stability/linear_stability.h>
#include <undine/coupled/stability/splitting_step.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/identity_matrix.h>
#include <deal.II/lac/parpack_solver.h>
#include <deal.II/lac/solver_cg.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>
#include <vector>

namespace undine
{
  namespace
  {
    using Vector  = dealii::TrilinosWrappers::MPI::Vector;
    using Parpack = dealii::PArpackSolver<Vector>;

    constexpr double       tolerances[]      = {1e-6, 1e-3}; // of eigenvalues of a step
    constexpr unsigned int most_restarts     = 15;
    constexpr unsigned int n_arnoldi_vectors = 40;
    constexpr double       cg_reduction      = 1e-10;
    constexpr unsigned int cg_iterations     = 300;


    struct InverseOf
    {
      void
      vmult(Vector &x, const Vector &b) const
      {
        x = factors.solve(b);
      }

      Factorisation &factors;
    };


    template <class Matrix, class Added>
    struct Sum
    {
      void
      vmult(Vector &result, const Vector &x) const
      {
        Vector further(x);
        added.vmult(further, x);
        matrix.vmult(result, x);
        result += further;
      }

      const Matrix &matrix;
      const Added  &added;
    };


    /// Nowhere near orthogonal to a mode, and the same on all numbers of ranks.
    Vector
    with_all_modes(Vector vector)
    {
      for (const auto row : vector.locally_owned_elements())
        vector(row) = 1 + 0.5 * std::sin(1.7 * row);
      vector.compress(dealii::VectorOperation::insert);
      return vector;
    }


    /// The largest eigenvalue of inertia^-1 A, one less than that of inertia^-1 (inertia + A), of
    /// which conjugate gradients with inertia^-1 for a preconditioner get to know the extremes.
    template <class Matrix, class Added>
    double
    largest_ratio(const Matrix &inertia, const Added &added, const Vector &layout)
    {
      Factorisation factors;
      factors.factorise(inertia);
      const Vector right_side = with_all_modes(layout);
      Vector       solution(layout);
      solution                               = 0;
      double                         largest = 1;
      dealii::IterationNumberControl control(cg_iterations, cg_reduction * right_side.l2_norm());
      dealii::SolverCG<Vector>       solver(control);
      solver.connect_eigenvalues_slot(
        [&](const std::vector<double> &eigenvalues) { largest = eigenvalues.back(); });
      solver.solve(Sum<Matrix, Added>{inertia, added}, solution, right_side, InverseOf{factors});
      return largest - 1;
    }


    /// The largest modulus of the eigenvalues of a linear map, from `first`; not a number if
    /// Arnoldi's method does not get so far, as where many lie on one circle.
    template <class Map>
    double
    spectral_radius(const Map &map, const Vector &first, const double tolerance)
    {
      // PARPACK fails on ranks without rows, and on these alone.
      if (dealii::Utilities::MPI::min(first.locally_owned_size(), first.get_mpi_communicator()) ==
          0)
        return std::numeric_limits<double>::quiet_NaN();
      const unsigned int    few = std::min<unsigned int>(n_arnoldi_vectors, first.size() - 1);
      dealii::SolverControl control(most_restarts, tolerance, false, false);
      Parpack               solver(control,
                     first.get_mpi_communicator(),
                     Parpack::AdditionalData(few, Parpack::largest_magnitude, false, 1));
      solver.reinit(first.locally_owned_elements());
      solver.set_initial_vector(first);
      std::vector<std::complex<double>> values(2);
      std::vector<Vector>               vectors(3, first);
      const dealii::IdentityMatrix      identity(first.size());
      try
        {
          solver.solve(map, identity, identity, values, vectors, 1);
        }
      catch (const dealii::ExceptionBase &)
        {
          return std::numeric_limits<double>::quiet_NaN();
        }
      return std::abs(values[0]);
    }


    /// The same with as much accuracy as there is to be had.
    template <class Map>
    double
    spectral_radius(const Map &map, const Vector &first)
    {
      double result = 0;
      for (const double tolerance : tolerances)
        if (result = spectral_radius(map, first, tolerance); std::isfinite(result))
          break;
      return result;
    }


    /// The step as a linear map of one vector: displacement over h, velocity, the velocity of
    /// surfaces and h times the forces over the mean mass of an unknown, all of which are
    /// velocities.
    template <int dim>
    class StepMap
    {
    public:
      using Motion = typename SplittingStep<dim>::Motion;

      StepMap(SplittingStep<dim> &step,
              const double        dt,
              const double        mass,
              const Vector       &of_bodies,
              const DrivenBy      driven_by)
        : step(step)
        , driven_by(driven_by)
        , units{{dt, 1, 1, mass / dt}}
        , of_bodies(of_bodies)
        , rows(dealii::Utilities::MPI::create_ascending_partitioning(
            of_bodies.get_mpi_communicator(),
            units.size() * of_bodies.locally_owned_size())[dealii::Utilities::MPI::this_mpi_process(
            of_bodies.get_mpi_communicator())])
      {
      }

      void
      vmult(Vector &result, const Vector &x) const
      {
        result = packed(step.after(unpacked(x), driven_by));
      }

      Vector
      packed(const Motion &motion) const
      {
        Vector        result(rows, of_bodies.get_mpi_communicator());
        double       *value = result.begin();
        const double *unit  = units.data();
        for (const auto *part :
             {&motion.displacement, &motion.velocity, &motion.surface, &motion.pressure_forces})
          {
            value = std::transform(part->begin(), part->end(), value, [&](const double of_part) {
              return of_part / *unit;
            });
            ++unit;
          }
        return result;
      }

    private:
      Motion
      unpacked(const Vector &x) const
      {
        Motion        result{of_bodies, of_bodies, of_bodies, of_bodies};
        const double *value = x.begin();
        const double *unit  = units.data();
        for (auto *part :
             {&result.displacement, &result.velocity, &result.surface, &result.pressure_forces})
          {
            for (auto &of_part : *part)
              of_part = *unit * *value++;
            ++unit;
          }
        return result;
      }

      SplittingStep<dim>         &step;
      const DrivenBy              driven_by;
      const std::array<double, 4> units;
      const Vector                of_bodies; ///< whatever: its layout counts
      const dealii::IndexSet      rows;
    };


    template <int dim>
    void
    assert_foretellable(const Models<dim> &models, const double dt)
    {
      if (!models.solid || !models.fluid || !models.surface)
        throw InputError("'Output / Stability of splitting' needs bodies in a fluid.");
      const auto &integrator = *models.solid->numerics().integrator;
      if (integrator.stages(dt, RatesAtBegin::known).size() > 1 || integrator.uses_acceleration() ||
          integrator.coefficients(dt).mass == 0)
        throw InputError("'Output / Stability of splitting' is for integrators of one stage that "
                         "have inertia in it and keep no accelerations. Try 'Time / Integrator = "
                         "theta' or 'newmark'.");
    }
  } // namespace


  template <int dim>
  SplittingStability
  splitting_stability(const Models<dim> &models, const State<dim> &state, const double dt)
  {
    assert_foretellable(models, dt);
    SplittingStep<dim> step(models, state, dt);
    if (!step.added_mass().is_finite())
      {
        const double infinite = std::numeric_limits<double>::infinity();
        return {infinite, infinite, infinite, {}};
      }
    const auto   layout  = models.solid->vector();
    const auto  &inertia = step.alternating_inertia();
    const double mass    = inertia.frobenius_norm() / std::sqrt(double(inertia.m()));
    const auto   growth  = [&](const DrivenBy driven_by) {
      const StepMap<dim> map(step, dt, mass, layout, driven_by);
      return spectral_radius(map, map.packed(step.alternating(with_all_modes(layout))));
    };
    return {largest_ratio(inertia, step.added_mass(), layout),
            growth(DrivenBy::velocity),
            growth(DrivenBy::displacement),
            {}};
  }


  template SplittingStability
  splitting_stability(const Models<2> &, const State<2> &, double);
  template SplittingStability
  splitting_stability(const Models<3> &, const State<3> &, double);
} // namespace undine
