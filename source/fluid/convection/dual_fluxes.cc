// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/boundary/boundary_condition.h>
#include <undine/fluid/boundary/side_faces.h>
#include <undine/fluid/convection/dual_fluxes.h>
#include <undine/fluid/grid/field_algebra.h>

#include <algorithm>

namespace undine
{
  template <int dim>
  DualFluxes<dim>::DualFluxes(const FluidModel<dim> &model,
                              const Velocity<dim>   &flow_,
                              const double           time)
    : model(model)
    , grid(model.grid())
    , flow(flow_)
    , time(time)
  {
    exchange(flow);
    set_widths();
    collect_pieces();
  }


  template <int dim>
  DualFluxes<dim>::DualFluxes(const FluidModel<dim> &model,
                              const Velocity<dim>   &flow,
                              const double           time,
                              const Motion          &motion_,
                              const Velocity<dim>   &unfitted_)
    : DualFluxes(model, flow, time)
  {
    motion.emplace(motion_);
    exchange(motion->start);
    unfitted = unfitted_;
    exchange(unfitted);
  }


  template <int dim>
  void
  DualFluxes<dim>::set_widths()
  {
    for (unsigned int d = 0; d < dim; ++d)
      for (int cell = -1; cell <= grid.cells_along()[d]; ++cell)
        widths[d].push_back(grid.periodic(d) || (cell >= 0 && cell < grid.cells_along()[d])
                              ? grid.cell_width(d, cell)
                              : 0.);
  }


  template <int dim>
  void
  DualFluxes<dim>::collect_pieces()
  {
    const auto *open = flow.topology();
    for (unsigned int axis = 0; open && axis < dim; ++axis)
      {
        pieces[axis].resize(open->cells.all().size());
        for (std::size_t k = 0; k < open->pieces[axis].size(); ++k)
          for (const unsigned int end : {0, 1})
            if (const int c = open->pieces[axis][k].components[end]; c >= 0)
              pieces[axis][c][1 - end].push_back(k);
      }
  }


  template <int dim>
  double
  DualFluxes<dim>::area(const unsigned int axis, const FacePlace<dim> &place) const
  {
    return place.part < 0 ? grid.face_area(axis, place.face)
                          : flow.topology()->faces[axis].all()[place.part].measure;
  }


  template <int dim>
  double
  DualFluxes<dim>::flux(const unsigned int axis, const FacePlace<dim> &place) const
  {
    return area(axis, place) * value_at(flow[axis], place);
  }


  /// What is below (end 0) or above a place of a face normal to `axis`.
  template <int dim>
  typename DualFluxes<dim>::CellPlace
  DualFluxes<dim>::beside(const unsigned int    axis,
                          const FacePlace<dim> &place,
                          const unsigned int    end) const
  {
    return {moved<dim>(place.face, axis, end == 0 ? -1 : 0),
            place.part < 0
              ? -1
              : std::max(-1, flow.topology()->pieces[axis][place.part].components[end])};
  }


  template <int dim>
  typename DualFluxes<dim>::Shares
  DualFluxes<dim>::shares(const CellPlace &place, const unsigned int axis) const
  {
    Shares     result;
    double     sum = 0;
    const auto add = [&](const FacePlace<dim> &of_face, const unsigned int end) {
      result.push_back({of_face, end, area(axis, of_face)});
      sum += result.back().share;
    };
    for (const unsigned int end : {0, 1})
      if (place.component < 0)
        undine::for_each_place(flow[axis].divided(),
                               moved<dim>(place.cell, axis, end),
                               [&](const FacePlace<dim> &of_face) { add(of_face, end); });
      else
        for (const int piece : pieces[axis][place.component][end])
          add({flow.topology()->faces[axis].all()[piece].index, piece}, end);
    for (auto &one : result)
      one.share /= sum;
    return result;
  }


  /// What a place of a component must get to keep the flow through it, and its volume.
  template <int dim>
  double
  DualFluxes<dim>::supply(const unsigned int axis, const Share &of) const
  {
    const double through = (of.end == 1 ? 1 : -1) * flux(axis, of.place);
    return motion ? through + value_at(motion->rates[1 - of.end][axis], of.place) : through;
  }


  /// What the places of one component exchange. Those that give do so in proportion to what others
  /// need.
  template <int dim>
  void
  DualFluxes<dim>::within(const Shares      &shares,
                          const unsigned int axis,
                          const Between     &action) const
  {
    double out = 0, most = 0;
    for (const auto &one : shares)
      out += supply(axis, one);
    boost::container::small_vector<double, 4> needs;
    for (const auto &one : shares)
      {
        needs.push_back(supply(axis, one) - one.share * out);
        most += std::max(0., needs.back());
      }
    const auto from_to = [&](const double giver, const double taker) {
      return giver < 0 && taker > 0 ? -giver * taker / most : 0.;
    };
    for (std::size_t i = 0; i < shares.size(); ++i)
      for (std::size_t j = i + 1; j < shares.size(); ++j)
        action(shares[i].place,
               shares[j].place,
               from_to(needs[i], needs[j]) - from_to(needs[j], needs[i]));
  }


  /// The lower places of one component exchange with the lower ones of the other, as far as their
  /// shares go.
  template <int dim>
  void
  DualFluxes<dim>::across(const Shares  &below,
                          const Shares  &above,
                          const double   flux,
                          const Between &action) const
  {
    std::size_t i = 0, j = 0;
    double      of_below = below.empty() ? 0 : below[0].share;
    double      of_above = above.empty() ? 0 : above[0].share;
    while (i < below.size() && j < above.size())
      {
        const double common = std::min(of_below, of_above);
        if (common > 0)
          action(below[i].place, above[j].place, common * flux);
        of_below -= common;
        of_above -= common;
        const bool below_is_done = of_below <= of_above;
        if (below_is_done)
          of_below = ++i < below.size() ? below[i].share : 0;
        else
          of_above = ++j < above.size() ? above[j].share : 0;
      }
  }


  /// The same as within(), where the cell and its faces are whole: half of the sum of two fluxes.
  template <int dim>
  void
  DualFluxes<dim>::within_whole_cell(const GridIndex<dim> &cell,
                                     const unsigned int    axis,
                                     const Between        &action) const
  {
    const FacePlace<dim> below{cell, -1}, above{moved<dim>(cell, axis, 1), -1};
    action(below, above, (flux(axis, below) + flux(axis, above)) / 2);
  }


  /// The same as across(), where all is whole.
  template <int dim>
  void
  DualFluxes<dim>::across_whole_face(const GridIndex<dim> &face,
                                     const unsigned int    d,
                                     const unsigned int    axis,
                                     const Between        &action) const
  {
    const double half = flux(d, {face, -1}) / 2;
    for (const unsigned int end : {0, 1})
      {
        const auto above = moved<dim>(face, axis, end);
        action({moved<dim>(above, d, -1), -1}, {above, -1}, half);
      }
  }


  /// Is a whole cell between whole faces normal to `axis`?
  template <int dim>
  bool
  DualFluxes<dim>::is_whole(const GridIndex<dim> &cell, const unsigned int axis) const
  {
    using Kind       = typename SubLattice<dim>::Kind;
    const auto *open = flow.topology();
    if (!open)
      return true;
    const auto &faces = open->faces[axis];
    return open->cells.kind(cell) == Kind::whole && faces.kind(cell) == Kind::whole &&
           faces.kind(moved<dim>(cell, axis, 1)) == Kind::whole;
  }


  template <int dim>
  void
  DualFluxes<dim>::rates_to_next(const unsigned int    axis,
                                 const unsigned int    direction,
                                 const GridIndex<dim> &first,
                                 std::vector<double>  &rates) const
  {
    // Half of the sum of the fluxes through two faces: those themselves, or those between the two
    // cells around the one face and the two around the other.
    const bool                    within  = direction == axis;
    const auto                   &through = flow[direction];
    const GridIndex<dim>          one     = moved<dim>(first, direction, within ? 0 : 1);
    const GridIndex<dim>          other   = moved<dim>(one, axis, within ? 1 : -1);
    std::array<double, 2>         factors{{0.5, 0.5}};
    std::array<const double *, 2> along{}, values{};
    const std::vector<double>     no_widths(rates.size(), 1.);
    for (const unsigned int k : {0, 1})
      {
        const auto &face = k == 0 ? one : other;
        for (unsigned int d = 1; d < dim; ++d)
          if (d != direction)
            factors[k] *= widths[d][face[d] + 1];
        along[k]  = direction == 0 ? no_widths.data() : widths[0].data() + face[0] + 1;
        values[k] = through.data(face);
      }
    for (std::size_t i = 0; i < rates.size(); ++i)
      rates[i] = factors[0] * along[0][i] * values[0][i] + factors[1] * along[1][i] * values[1][i];
  }


  template <int dim>
  void
  DualFluxes<dim>::for_each_between(const unsigned int axis, const Between &action) const
  {
    const auto *open = flow.topology();
    undine::for_each(grid.cells()->owned(), [&](const GridIndex<dim> &cell) {
      if (!motion && is_whole(cell, axis))
        within_whole_cell(cell, axis, action);
      else if (!open || open->cells.kind(cell) == SubLattice<dim>::Kind::whole)
        within(shares({cell, -1}, axis), axis, action);
    });
    for (std::size_t c = 0; open && c < open->cells.all().size(); ++c)
      if (open->cells.owns(c))
        within(shares({open->cells.all()[c].index, static_cast<int>(c)}, axis), axis, action);

    for (unsigned int d = 0; d < dim; ++d)
      if (d != axis)
        undine::for_each(grid.faces(d)->owned(), [&](const GridIndex<dim> &face) {
          if (grid.at_boundary(d, face))
            return;
          if ((!open || open->faces[d].kind(face) == SubLattice<dim>::Kind::whole) &&
              is_whole(moved<dim>(face, d, -1), axis) && is_whole(face, axis))
            across_whole_face(face, d, axis, action);
          else
            undine::for_each_place(flow[d].divided(), face, [&](const FacePlace<dim> &place) {
              across(shares(beside(d, place, 0), axis),
                     shares(beside(d, place, 1), axis),
                     flux(d, place),
                     action);
            });
        });
  }


  /// action(SideFace, accepts) for the faces on sides of the domain beside which this rank has
  /// places of faces normal to `axis`; of these it has those that are accepted.
  template <int dim>
  template <class Action>
  void
  DualFluxes<dim>::for_each_side(const unsigned int axis, const Action &action) const
  {
    if (flow.topology())
      {
        for_each_side_face(grid, flow.topology(), [&](const SideFace<dim> &at, const auto &) {
          action(at, [](const FacePlace<dim> &) { return true; });
        });
        return;
      }
    // Nothing is cut: each rank sees what enters its own places, also by cells of another one or by
    // an image of its own.
    const auto &owned  = grid.faces(axis)->owned();
    const auto  is_own = [&](const FacePlace<dim> &place) { return owned.contains(place.face); };
    for_each_side_face(
      grid, flow.topology(), [&](const SideFace<dim> &at, const auto &) { action(at, is_own); });
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int end = 0; end < 2 && d != axis && !grid.periodic(d); ++end)
        {
          const int plane   = end == 0 ? 0 : grid.cells_along()[d];
          auto      below   = grid.faces(d)->owned();
          below.lower[d]    = std::max(below.lower[d], plane);
          below.upper[d]    = std::min(below.upper[d], plane + 1);
          below.upper[axis] = below.lower[axis];
          if (grid.periodic(axis) || below.lower[axis] > 0)
            --below.lower[axis];
          undine::for_each(below, [&](const GridIndex<dim> &face) {
            const auto cell = end == 0 ? face : moved<dim>(face, d, -1);
            action(SideFace<dim>{{d, end}, face, cell, -1}, is_own);
          });
        }
  }


  template <int dim>
  void
  DualFluxes<dim>::for_each_entering(const unsigned int axis, const Entering &action) const
  {
    for_each_side(axis, [&](const SideFace<dim> &at, const auto &accepts) {
      const unsigned int d        = at.side.axis;
      const auto        &boundary = model.boundaries().at(at.side, at.cell);
      if (d == axis && boundary.prescribes_normal_velocity())
        return;
      const FacePlace<dim> place{at.face, at.piece};
      const double         entering = -at.side.sign() * flux(d, place);
      if (entering <= 0)
        return;
      const double genuine = boundary.is_open() ? genuine_share(d, place, entering) : 1;
      const auto   bring   = [&](const FacePlace<dim> &to, const double rate, double brought) {
        if (!accepts(to))
          return;
        if (genuine < 1)
          brought = genuine * brought + (1 - genuine) * value_at(motion->start[axis], to);
        action(to, rate, brought);
      };
      if (d == axis)
        {
          bring(place, entering, value_at((motion ? unfitted : flow)[d], place));
          return;
        }
      const double brought = entering_velocity(boundary, d, grid.faces(d)->wrapped(at.face), axis);
      for (const auto &one : shares(beside(d, place, 1 - at.side.end), axis))
        bring(one.place, one.share * entering, brought);
    });
  }


  template <int dim>
  void
  DualFluxes<dim>::for_each_extrapolated(const unsigned int axis, const Extrapolated &action) const
  {
    for_each_side(axis, [&](const SideFace<dim> &at, const auto &accepts) {
      const unsigned int d       = at.side.axis;
      const double       leaving = at.side.sign() * flux(d, {at.face, at.piece});
      if (d == axis || grid.cells_along()[d] < 2 || leaving <= 0)
        return;
      const auto inward  = [&](const auto &index) { return moved<dim>(index, d, -at.side.sign()); };
      const auto place   = beside(d, {at.face, at.piece}, 1 - at.side.end);
      const double width = grid.cell_width(d, at.cell[d]);
      const double share = width / (width + grid.cell_width(d, inward(at.cell)[d]));
      // Through all that joins it to the cell behind, in proportion to areas.
      boost::container::small_vector<FacePlace<dim>, 2> joints;
      double                                            sum = 0;
      undine::for_each_place(flow[d].divided(), inward(at.face), [&](const FacePlace<dim> &joint) {
        if (beside(d, joint, at.side.end).component != place.component)
          return;
        joints.push_back(joint);
        sum += area(d, joint);
      });
      for (const auto &joint : joints)
        across(shares(beside(d, joint, 1 - at.side.end), axis),
               shares(place, axis),
               share * leaving * area(d, joint) / sum,
               [&](const FacePlace<dim> &behind, const FacePlace<dim> &of_side, const double rate) {
                 if (accepts(of_side))
                   action(of_side, behind, rate);
               });
    });
  }


  /// Along `axis`, of what enters through a face normal to `d` [m/s]: at right angles through
  /// openings.
  template <int dim>
  double
  DualFluxes<dim>::entering_velocity(const Boundary<dim>  &boundary,
                                     const unsigned int    d,
                                     const GridIndex<dim> &face,
                                     const unsigned int    axis) const
  {
    const VelocityCondition<dim> condition(axis);
    return condition.is_dirichlet(boundary)
             ? condition.dirichlet_value(boundary, d, grid.faces(d)->point(face), time)
             : 0;
  }


  /// Of what enters, `entering` [m^dim/s]: what does so by the flow itself.
  template <int dim>
  double
  DualFluxes<dim>::genuine_share(const unsigned int    d,
                                 const FacePlace<dim> &place,
                                 const double          entering) const
  {
    if (!motion)
      return 1;
    const double itself =
      (place.face[d] == 0 ? 1 : -1) * area(d, place) * value_at(unfitted[d], place);
    return std::clamp(itself / entering, 0., 1.);
  }


  template <int dim>
  void
  DualFluxes<dim>::for_each_leaving(const unsigned int axis, const Leaving &action) const
  {
    for_each_side_face(grid, flow.topology(), [&](const SideFace<dim> &at, const auto &) {
      const unsigned int   d = at.side.axis;
      const FacePlace<dim> place{at.face, at.piece};
      const double         leaving = at.side.sign() * flux(d, place);
      if (d == axis)
        action(place, leaving);
      else
        for (const auto &one : shares(beside(d, place, 1 - at.side.end), axis))
          action(one.place, one.share * leaving);
    });
  }


  template class DualFluxes<2>;
  template class DualFluxes<3>;
} // namespace undine
