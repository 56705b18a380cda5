// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/fluid/viscosity/friction_with_bodies.h>

#include <deal.II/lac/solver_gmres.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace undine
{
  namespace
  {
    /// One component of a vector in each node.
    template <int dim>
    std::vector<double>
    along(const std::vector<dealii::Tensor<1, dim>> &vectors, const unsigned int axis)
    {
      std::vector<double> result;
      result.reserve(vectors.size());
      for (const auto &vector : vectors)
        result.push_back(vector[axis]);
      return result;
    }


    template <int dim>
    void
    set_along(std::vector<dealii::Tensor<1, dim>> &vectors,
              const unsigned int                   axis,
              const std::vector<double>           &values)
    {
      for (std::size_t node = 0; node < vectors.size(); ++node)
        vectors[node][axis] = values[node];
    }


    NodeDampings
    diagonal(const std::vector<double> &damping)
    {
      NodeDampings result;
      for (unsigned int node = 0; node < damping.size(); ++node)
        if (damping[node] != 0)
          result.push_back({node, node, damping[node]});
      return result;
    }


    /// What solvers of deal.II call a matrix.
    template <class Action>
    struct Operator
    {
      template <class BlockVector>
      void
      vmult(BlockVector &result, const BlockVector &x) const
      {
        action(result, x);
      }

      Action action;
    };
    template <class Action>
    Operator(Action) -> Operator<Action>;
  } // namespace


  template <int dim>
  FrictionWithBodies<dim>::FrictionWithBodies(const Equations    &equations,
                                              BodyImpedance<dim> &bodies,
                                              const double        dt)
    : equations(equations)
    , bodies(bodies)
    , dt(dt)
    , of_nodes(bodies.velocities().size())
  {
    std::array<NodeDampings, dim> matrices;
    x.reinit(dim + 1);
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        x.block(axis)      = equations[axis]->guess();
        const auto damping = equations[axis]->damping();
        matrices[axis]     = diagonal(damping);
        set_along(of_nodes, axis, damping);
      }
    x.block(dim) = bodies.vector();
    x.collect_sizes();
    bodies.prepare(matrices);
  }


  template <int dim>
  typename FrictionWithBodies<dim>::Vectors
  FrictionWithBodies<dim>::friction_by(const BlockVector &of, const Vectors &change) const
  {
    Vectors result(change.size());
    for (unsigned int axis = 0; axis < dim; ++axis)
      set_along(result, axis, equations[axis]->friction_by(of.block(axis), along(change, axis)));
    return result;
  }


  template <int dim>
  void
  FrictionWithBodies<dim>::vmult(BlockVector &result, const BlockVector &of) const
  {
    const auto change = bodies.on_surfaces(of.block(dim));
    for (unsigned int axis = 0; axis < dim; ++axis)
      equations[axis]->vmult(result.block(axis), of.block(axis), along(change, axis));
    result.block(dim) = bodies.force(of.block(dim));
    result.block(dim).add(-1., bodies.on_bodies(friction_by(of, change)));
    result.block(dim) *= dt;
  }


  /// First the fluid around surfaces that do not give way, then the bodies.
  template <int dim>
  void
  FrictionWithBodies<dim>::precondition(BlockVector &result, const BlockVector &b) const
  {
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        equations[axis]->precondition(result.block(axis), b.block(axis));
        if (!std::isfinite(result.block(axis).l2_norm()))
          throw dealii::SolverControl::NoConvergence(0, result.block(axis).l2_norm());
      }
    auto force = b.block(dim);
    force *= 1 / dt;
    force.add(1., bodies.on_bodies(friction_by(result, Vectors(bodies.velocities().size()))));
    result.block(dim) = bodies.approximate_change(force);
  }


  /// Friction on the bodies by what is given: prescribed faces, sides, and the velocities u0.
  template <int dim>
  typename FrictionWithBodies<dim>::BlockVector
  FrictionWithBodies<dim>::load() const
  {
    BlockVector result(x);
    Vectors     given(bodies.velocities().size());
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        result.block(axis) = equations[axis]->load();
        set_along(given, axis, equations[axis]->given_friction());
      }
    result.block(dim) = bodies.load();
    result.block(dim).add(1., bodies.on_bodies(given));
    result.block(dim) *= dt;
    return result;
  }


  /// Tight, so that rank counts agree, but not below the rounding of what stiff bodies answer with;
  /// a load of zero has the solution zero.
  template <int dim>
  double
  FrictionWithBodies<dim>::tolerance(const BlockVector &right_side) const
  {
    auto force = right_side.block(dim);
    force *= 1 / dt;
    const double rounding = dt * bodies.rounding(bodies.approximate_change(force));
    return std::max({1e-12 * right_side.l2_norm(), 10 * rounding, 1e-300});
  }


  template <int dim>
  unsigned int
  FrictionWithBodies<dim>::iterate(const BlockVector &right_side,
                                   const unsigned int most_iterations)
  {
    using Gmres = dealii::SolverFGMRES<BlockVector>;
    dealii::SolverControl control(most_iterations, tolerance(right_side));
    Gmres(control, typename Gmres::AdditionalData(100))
      .solve(Operator{[&](BlockVector &result, const BlockVector &of) { vmult(result, of); }},
             x,
             right_side,
             Operator{[&](BlockVector &result, const BlockVector &b) { precondition(result, b); }});
    return control.last_step();
  }


  /// A diagonal does not tell how little of the fluid's resistance is left where nodes move
  /// together: very light bodies need the matrix.
  template <int dim>
  void
  FrictionWithBodies<dim>::precondition_by_matrix()
  {
    std::array<NodeDampings, dim> matrices;
    for (unsigned int axis = 0; axis < dim; ++axis)
      matrices[axis] = equations[axis]->damping_matrix();
    bodies.prepare(matrices);
  }


  template <int dim>
  unsigned int
  FrictionWithBodies<dim>::solve()
  {
    const auto of_fluid = [&](void (ImmersedViscousTerm<dim>::*prepare)()) {
      return [this, prepare] {
        for (auto *equation : equations)
          (equation->*prepare)();
      };
    };
    struct Try
    {
      unsigned int          most_iterations;
      std::function<void()> prepare;
    };
    const Try tries[] = {{60, [] {}},
                         {300, [&] { precondition_by_matrix(); }},
                         {1000, of_fluid(&ImmersedViscousTerm<dim>::precondition_by_diagonal)},
                         {600, of_fluid(&ImmersedViscousTerm<dim>::precondition_by_factors)}};

    const auto        right_side = load();
    const BlockVector guess      = x;
    unsigned int      before     = 0;
    double            left       = 0;
    for (const auto &[most_iterations, prepare] : tries)
      try
        {
          prepare();
          return before + iterate(right_side, most_iterations);
        }
      catch (const dealii::SolverControl::NoConvergence &failure)
        {
          if (!std::isfinite(x.l2_norm()))
            x = guess;
          left = failure.last_residual / right_side.l2_norm();
          before += failure.last_step;
        }
    if (!std::isfinite(right_side.l2_norm()))
      throw SolveError(
        "The forces on fluid and bodies are not numbers. Try: look at expressions for "
        "openings, walls that move and loads, whether they have a value everywhere at "
        "this time.");
    throw SolveError(
      fmt::format("The fluid's implicit terms and the bodies did not converge in {} iterations: "
                  "{:.1e} of the forces are left. Try a smaller step.",
                  before,
                  left));
  }


  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  FrictionWithBodies<dim>::finish(Velocity<dim> &velocity) const
  {
    const auto change = bodies.on_surfaces(x.block(dim));
    for (unsigned int axis = 0; axis < dim; ++axis)
      equations[axis]->finish(velocity[axis], x.block(axis), along(change, axis));
    return change;
  }


  template class FrictionWithBodies<2>;
  template class FrictionWithBodies<3>;
} // namespace undine
