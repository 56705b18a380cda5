// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_field_h
#define undine_fluid_field_h

#include <undine/fluid/index_box.h>
#include <undine/fluid/lattice.h>

#include <memory>
#include <vector>

namespace undine
{
  /// One number at every point of a lattice, distributed over the ranks: each stores the points it
  /// owns and, after exchange(), any number of layers around them. A value: copies are deep.
  template <int dim>
  class Field
  {
  public:
    /// Empty.
    Field() = default;

    /// Zero at every point.
    explicit Field(std::shared_ptr<const Lattice<dim>> lattice);

    const Lattice<dim> &
    lattice() const
    {
      return *points;
    }

    const std::shared_ptr<const Lattice<dim>> &
    shared_lattice() const
    {
      return points;
    }

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

    std::ptrdiff_t
    stride(const unsigned int direction) const
    {
      return strides[direction];
    }
    /// @}

    /// Fetch `width[d]` layers on either side from the ranks that own them, periodic images
    /// included. Boundary points (see Row) become stored, with unchanged or zero values.
    /// Collective; `width` must be the same on all ranks.
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

  private:
    std::size_t
    position(const GridIndex<dim> &index) const
    {
      std::ptrdiff_t result = 0;
      for (unsigned int d = 0; d < dim; ++d)
        result += (index[d] - box.lower[d]) * strides[d];
      return result;
    }

    void
    store(const IndexBox<dim> &new_box);

    std::shared_ptr<const Lattice<dim>> points;
    IndexBox<dim>                       box;
    std::array<std::ptrdiff_t, dim>     strides{};
    std::vector<double>                 values;
  };
} // namespace undine

#endif
