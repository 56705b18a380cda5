// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_visible_stencil_h
#define undine_fluid_visible_stencil_h

#include <undine/fluid/lattice.h>

#include <array>
#include <limits>
#include <optional>

namespace undine
{
  /// Cubic interpolation at a place of which some of the (up to) 4^dim samples around are hidden
  /// behind bodies. Along each line of the stencil those are what the parabola through the nearest
  /// three that can be seen continues to (with fewer, the line or the constant); then along the
  /// lines of the next direction. The result stays between the smallest and the largest sample seen.
  template <int dim>
  class VisibleStencil
  {
  public:
    VisibleStencil(const Lattice<dim> &lattice, const dealii::Point<dim> &place);

    /// The lowest and the highest point of the stencil. @{
    GridIndex<dim>
    lower() const;
    GridIndex<dim>
    upper() const;
    /// @}

    /// Call `sample(index)`, a std::optional<double>, for every point of the stencil.
    template <class Sample>
    void
    look(Sample &&sample)
    {
      for (unsigned int k = 0; k < size; ++k)
        if (const std::optional<double> value = sample(index_of(k)))
          note(k, *value);
    }

    /// Nothing if no sample has been seen.
    std::optional<double>
    value();

  private:
    static constexpr unsigned int most = dim == 2 ? 16 : 64;

    GridIndex<dim>
    index_of(unsigned int k) const;
    void
    note(unsigned int k, double value);
    void
    fill_along(unsigned int axis);
    void
    fill_line(unsigned int first, unsigned int axis);

    std::array<Row::Stencil, dim>             rows;
    std::array<std::array<double, 4>, dim>    places;  ///< of the points of each row [m]
    std::array<unsigned int, dim + 1>         strides; ///< in `values`
    unsigned int                              size;
    std::array<double, most>                  values;
    std::array<bool, most>                    known;
    double smallest = std::numeric_limits<double>::infinity();
    double largest  = -std::numeric_limits<double>::infinity();
  };
} // namespace undine

#endif
