// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_grid_field_h
#define undine_fluid_grid_field_h

#include <undine/fluid/grid/fluid_topology.h>
#include <undine/fluid/grid/index_box.h>
#include <undine/fluid/grid/lattice.h>

#include <memory>
#include <vector>

namespace undine
{
  /// One number at every point of a lattice, distributed over the ranks: each stores the points it
  /// owns and, after exchange(), any number of ghost layers around them. Where bodies divide a
  /// point there is also a number for each of its sub-cells or sub-faces ("parts"), and that of the
  /// point is their mean (see SubLattice). A value: copies are deep.
  template <int dim>
  class Field
  {
  public:
    static constexpr int dimension = dim;

    /// Empty.
    Field() = default;

    /// Zero at every owned point and in every part. `topology`: of the fluid between bodies;
    /// nullptr: nothing is cut.
    explicit Field(std::shared_ptr<const Lattice<dim>>       lattice,
                   std::shared_ptr<const FluidTopology<dim>> topology = nullptr);

    /// False only if it is empty.
    bool
    has_lattice() const
    {
      return points != nullptr;
    }

    const Lattice<dim> &
    lattice() const
    {
      return *points;
    }

    /// The lattice, to be shared with other fields.
    const std::shared_ptr<const Lattice<dim>> &
    shared_lattice() const
    {
      return points;
    }

    /// The topology of the fluid; nullptr: nothing is cut.
    const std::shared_ptr<const FluidTopology<dim>> &
    topology() const
    {
      return open;
    }

    /// Values stay as they are; `equal_parts` must be what topology() is, as another object.
    void
    share(const std::shared_ptr<const FluidTopology<dim>> &equal_parts)
    {
      AssertDimension(divided()->all().size(), equal_parts->of(*points).all().size());
      open = equal_parts;
    }

    /// How bodies divide this field's points; nullptr: not at all.
    const SubLattice<dim> *
    divided() const
    {
      return open ? &open->of(*points) : nullptr;
    }

    /// The values of all sub-cells or sub-faces that this rank knows, [divided()->all()]; empty if
    /// divided() is nullptr. @{
    const std::vector<double> &
    parts() const
    {
      return part_values;
    }

    std::vector<double> &
    parts()
    {
      return part_values;
    }
    /// @}

    /// The points of this rank.
    const IndexBox<dim> &
    owned() const
    {
      return points->owned();
    }

    /// The points whose values are at hand: owned() and the ghost layers exchanged so far.
    const IndexBox<dim> &
    stored() const
    {
      return box;
    }

    /// The value at a stored point. @{
    double
    operator()(const GridIndex<dim> &index) const
    {
      return values[position(index)];
    }

    double &
    operator()(const GridIndex<dim> &index)
    {
      return values[position(index)];
    }
    /// @}

    /// The value at a stored point, and the distance in data() to the next one in a direction. @{
    const double *
    data(const GridIndex<dim> &index) const
    {
      return values.data() + position(index);
    }

    double *
    data(const GridIndex<dim> &index)
    {
      return values.data() + position(index);
    }

    std::ptrdiff_t
    stride(const unsigned int direction) const
    {
      return strides[direction];
    }
    /// @}

    /// Fetch `width[d]` layers on either side from the ranks that own them, periodic images
    /// included, and the values of sub-cells or sub-faces that other ranks own. Boundary points
    /// (see Row) become stored, with unchanged or zero values. Collective; `width` must be the same
    /// on all ranks.
    void
    exchange(const GridIndex<dim> &width);

    /// The same width in all directions.
    void
    exchange(const int width = 1);

    /// For files and vectors: the owned values, the first direction running fastest. The owned
    /// box and lattice().shape() say where they belong in the whole. @{
    std::vector<double>
    owned_values() const;

    void
    set_owned_values(const std::vector<double> &owned_values);
    /// @}

    /// Memory of the values on this rank [bytes].
    std::size_t
    memory_consumption() const
    {
      return sizeof(double) * (values.capacity() + part_values.capacity());
    }

  private:
    std::size_t
    position(const GridIndex<dim> &index) const
    {
      Assert(box.contains(index), dealii::ExcMessage("no such value, or exchange() is missing"));
      std::ptrdiff_t result = 0;
      for (unsigned int d = 0; d < dim; ++d)
        result += (index[d] - box.lower[d]) * strides[d];
      return result;
    }

    void
    store(const IndexBox<dim> &new_box);

    std::shared_ptr<const Lattice<dim>>       points;
    std::shared_ptr<const FluidTopology<dim>> open;
    GridIndex<dim>                            layers{}; ///< of ghost points that are stored
    IndexBox<dim>                             box;
    std::array<std::ptrdiff_t, dim>           strides{};
    std::vector<double>                       values;
    std::vector<double>                       part_values;
  };


  /// Call `action(k, part)` for every sub-cell or sub-face (SubLattice::Part) that this rank owns,
  /// k being its number in `divided->all()`; nullptr: there are none.
  template <int dim, class Action>
  void
  for_each_owned_part(const SubLattice<dim> *divided, Action &&action)
  {
    for (unsigned int k = 0; divided != nullptr && k < divided->all().size(); ++k)
      if (divided->owns(k))
        action(k, divided->all()[k]);
  }


  /// Call `action(value, place, index)` for every sub-cell or sub-face that this rank owns: the
  /// field's value there, the centroid [m] and the point that it is a part of.
  template <class FieldType, class Action>
  void
  for_each_part(FieldType &field, Action &&action)
  {
    for_each_owned_part(field.divided(), [&](const unsigned int k, const auto &part) {
      action(field.parts()[k], part.place, part.index);
    });
  }


  /// Call `action(value, place, index)` for every owned value of a field: those of the points that
  /// are whole, with the point's place, then those of the sub-cells or sub-faces of divided points,
  /// with their centroids.
  template <class FieldType, class Action>
  void
  for_each_value(FieldType &field, Action &&action)
  {
    constexpr int dim     = FieldType::dimension;
    const auto   *divided = field.divided();
    for_each(field.owned(), [&](const GridIndex<dim> &index) {
      if (!divided || divided->kind(index) == SubLattice<dim>::Kind::whole)
        action(field(index), field.lattice().point(index), index);
    });
    for_each_part(field, action);
  }


  /// Call `action(value)` for the same values in the same order.
  template <class FieldType, class Action>
  void
  for_each_unplaced_value(FieldType &field, Action &&action)
  {
    constexpr int dim     = FieldType::dimension;
    const auto   *divided = field.divided();
    for_each_row(field.owned(), [&](const GridIndex<dim> &first, const int n) {
      auto *const values = field.data(first);
      for (int i = 0; i < n; ++i)
        if (!divided || divided->kind(moved<dim>(first, 0, i)) == SubLattice<dim>::Kind::whole)
          action(values[i]);
    });
    for_each_owned_part(divided,
                        [&](const unsigned int k, const auto &) { action(field.parts()[k]); });
  }
} // namespace undine

#endif
