// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_grid_sub_lattice_h
#define undine_fluid_grid_sub_lattice_h

#include <undine/fluid/grid/lattice.h>

#include <deal.II/base/point.h>

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace undine
{
  /// The owned points of this rank and one layer around them, as far as there are points.
  template <int dim>
  IndexBox<dim>
  known_points(const Lattice<dim> &lattice);

  /// How bodies divide the points of a lattice: a cell into sub-cells, the connected components of
  /// its fluid; a face into sub-faces, its open pieces. Either is a "part" of the point. At a
  /// divided point a field has one value for each part (see Field::parts()), and its value on the
  /// lattice is a mean: of a cell over the volume of its fluid, of a face the flux through all
  /// pieces over the whole area.
  template <int dim>
  class SubLattice
  {
  public:
    /// A sub-cell or a sub-face.
    struct Part
    {
      GridIndex<dim>     index;   ///< of the point that it is a part of
      dealii::Point<dim> place;   ///< its centroid [m]
      double             measure; ///< volume of a component [m^dim], area of a piece [m^(dim-1)]
    };

    /// What a point is.
    enum class Kind : std::uint8_t
    {
      whole,   ///< open to fluid all over
      divided, ///< consists of parts; if there are none it is closed, but next to a cut
      closed   ///< in a body
    };

    /// Nothing is divided.
    SubLattice() = default;

    /// `kinds` of the owned points and one layer around them, as far as there are points, the first
    /// direction running fastest. `parts` in that order of their points; all ranks that know a
    /// divided point list its parts in the same order. Collective.
    SubLattice(std::shared_ptr<const Lattice<dim>> lattice,
               const std::vector<Kind>            &kinds,
               const std::vector<Part>            &parts);

    /// All parts that this rank knows, in the order in which the constructor got them.
    const std::vector<Part> &
    all() const
    {
      return parts;
    }

    /// True if this rank owns part number `part`.
    bool
    owns(const int part) const
    {
      return lattice->owned().contains(parts[part].index);
    }

    /// What lies beyond the points that this rank knows counts as whole.
    Kind
    kind(const GridIndex<dim> &index) const
    {
      return box.contains(index) ? kinds[box.position(index)] : Kind::whole;
    }

    /// The parts of a divided point are number first..last-1. @{
    int
    first(const GridIndex<dim> &index) const
    {
      const auto found = first_parts.find(box.position(index));
      return found == first_parts.end() ? 0 : found->second.first;
    }

    int
    last(const GridIndex<dim> &index) const
    {
      const auto found = first_parts.find(box.position(index));
      return found == first_parts.end() ? 0 : found->second.second;
    }
    /// @}

    /// Fetch the values of parts that other ranks own; `values` [all parts]. Collective.
    void
    exchange(std::vector<double> &values) const;

  private:
    void
    find_owners();

    std::shared_ptr<const Lattice<dim>>        lattice;
    IndexBox<dim>                              box; ///< of `kinds`
    std::vector<Kind>                          kinds;
    std::vector<Part>                          parts;
    std::map<std::size_t, std::pair<int, int>> first_parts;
    std::map<unsigned int, std::vector<int>>   wanted;  ///< by rank: parts that it owns
    std::map<unsigned int, std::vector<int>>   offered; ///< by rank: parts that it wants
  };

  /// Call `action(part)` for the parts of a divided point.
  template <int dim, class Action>
  void
  for_each_part(const SubLattice<dim> &divided, const GridIndex<dim> &index, Action &&action)
  {
    const int last = divided.last(index);
    for (int part = divided.first(index); part < last; ++part)
      action(part);
  }
} // namespace undine

#endif
