// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_fluid_scene_h
#define undine_tests_fluid_scene_h

#include <undine/fluid/model/fluid_model.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include <fmt/format.h>
#include <message_of.h>
#include <scene_text.h>

#include <cmath>
#include <cstdio>
#include <string>

namespace undine_tests
{
  using namespace undine;

  constexpr double pi = dealii::numbers::PI;


  /// "subsection NAME ... end", with keys separated by ';;'.
  inline std::string
  section(const std::string &name, const std::string &content)
  {
    return "subsection " + name + "\n" + content + "\nend\n";
  }


  inline std::string
  boundary(const std::string &name,
           const std::string &sides,
           const std::string &kind,
           const std::string &more = "")
  {
    return section(name, "set Sides = " + sides + "\nset Kind = " + kind + "\n" + more);
  }


  template <int dim>
  std::string
  every_side()
  {
    return dim == 2 ? "left, right, bottom, top" : "left, right, bottom, top, back, front";
  }


  /// What a test says about a fluid; the rest is a unit cube of water without friction.
  struct FluidText
  {
    std::string cells;
    std::string boundaries = "";
    std::string velocity   = "";
    std::string domain     = ""; ///< further keys
    double      density    = 1;
    std::string fluid      = ""; ///< further keys

    operator std::string() const
    {
      return section("Domain", "set Cells = " + cells + "\n" + domain) +
             section("Fluid",
                     fmt::format("set Density = {}\n", density) +
                       (velocity.empty() ? "" : "set Initial velocity = " + velocity + "\n") +
                       fluid + "\n" + section("Boundaries", boundaries));
    }
  };


  template <int dim>
  FluidModel<dim>
  make_model(const std::string &text)
  {
    return FluidModel<dim>(read_scene_text(text), MPI_COMM_WORLD);
  }


  /// A number between -1 and 1 that depends on the global index only, not on the rank.
  template <int dim>
  double
  scatter(const GridIndex<dim> &index, const unsigned int seed)
  {
    double sum = 0.37 * seed;
    for (unsigned int d = 0; d < dim; ++d)
      sum = std::sin(12.9898 * sum + 78.233 * (index[d] + 1) * (d + 1));
    return sum;
  }


  template <int dim>
  void
  fill_scattered(Field<dim> &field, const unsigned int seed)
  {
    for_each(field.owned(),
             [&](const GridIndex<dim> &index) { field(index) = scatter<dim>(index, seed); });
  }


  template <int dim>
  void
  fill_scattered(Velocity<dim> &velocity)
  {
    for (unsigned int axis = 0; axis < dim; ++axis)
      fill_scattered(velocity[axis], axis + 1);
  }


  /// Sum over all ranks of `value(index)` over the owned points of a lattice.
  template <int dim, class Value>
  double
  sum_over(const Lattice<dim> &lattice, const Value &value)
  {
    double sum = 0;
    for_each(lattice.owned(), [&](const GridIndex<dim> &index) { sum += value(index); });
    return dealii::Utilities::MPI::sum(sum, lattice.blocks().communicator());
  }


  template <int dim, class Value>
  double
  largest_over(const Lattice<dim> &lattice, const Value &value)
  {
    double result = 0;
    for_each(lattice.owned(),
             [&](const GridIndex<dim> &index) { result = std::max(result, value(index)); });
    return dealii::Utilities::MPI::max(result, lattice.blocks().communicator());
  }
} // namespace undine_tests

#endif
