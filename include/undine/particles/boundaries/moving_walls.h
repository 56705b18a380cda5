// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_boundaries_moving_walls_h
#define undine_particles_boundaries_moving_walls_h

#include <undine/particles/execution/atomics.h>
#include <undine/particles/execution/buffer.h>
#include <undine/particles/model/constants.h>
#include <undine/particles/model/particle.h>
#include <undine/particles/model/step_control.h>

#include <vector>

namespace undine::particles
{
  /// How a particle of a moving wall moves in a frame: along the cubic with these ends.
  template <int dim, class Real>
  struct WallPath
  {
    Vector<dim, Real> start;             ///< place at the frame's start [m]
    Vector<dim, Real> way;               ///< from there to the place at its end [m]
    Vector<dim, Real> v_start, v_end;    ///< velocities at both [m/s]
    Kind              kind = Kind::wall; ///< or Kind::dummy
  };

  /// Of all particles of moving walls, in the order of their identities.
  template <int dim>
  using WallPaths = std::vector<WallPath<dim, double>>;


  /// Places the particles of moving walls where they are at the end of a sub-step. Their velocity
  /// is the mean one of the sub-step: what the fluid has to make room for. Those that have left the
  /// box are dummies; nothing is near them.
  template <int dim, class Real>
  struct MoveWalls
  {
    CellGrid<dim, Real>        grid;
    const WallPath<dim, Real> *paths;
    int                        first; ///< identity of paths[0]
    const int                 *identities;
    Place<dim, Real>          *places;
    Motion<dim, Real>         *motions;
    StepControl               *control;

    UNDINE_HOST_DEVICE
    void
    operator()(const int i) const
    {
      if (places[i].tag.material() != moving_material || control->done())
        return;
      const WallPath<dim, Real> path = paths[identities[i] - first];
      const Shares              now  = shares(control->elapsed);
      const Shares              then = shares(control->elapsed - control->dt);
      const Real                rate = static_cast<Real>(1 / control->dt);
      Place<dim, Real>          place;
      place.x   = grid.wrapped(path.start + moved(path, now));
      place.tag = Tag::of(path.kind, moving_material);
      motions[i].v =
        rate *
        moved(path, {now.way - then.way, now.v_start - then.v_start, now.v_end - then.v_end});
      atomic_maximum(&control->largest_speed,
                     static_cast<float>(square_root(norm_square(motions[i].v))));
      if (!grid.contains(place.x))
        place.tag = Tag::of(Kind::dummy, moving_material);
      places[i] = place;
    }

  private:
    /// Of the parts of a path in the way until some time: Hermite's polynomials.
    struct Shares
    {
      double way;            ///< [1]
      double v_start, v_end; ///< [s]
    };

    UNDINE_HOST_DEVICE
    Shares
    shares(const double elapsed) const
    {
      const double s = elapsed / control->frame;
      return {s * s * (3 - 2 * s),
              control->frame * s * (1 - s) * (1 - s),
              control->frame * s * s * (s - 1)};
    }

    UNDINE_HOST_DEVICE
    static Vector<dim, Real>
    moved(const WallPath<dim, Real> &path, const Shares &shares)
    {
      return static_cast<Real>(shares.way) * path.way +
             static_cast<Real>(shares.v_start) * path.v_start +
             static_cast<Real>(shares.v_end) * path.v_end;
    }
  };


  /// Fixed walls count for nothing where a moving one is: it may come out of them, slide along them
  /// or go into them.
  template <int dim, class Real>
  struct DeactivateWalls
  {
    CellGrid<dim, Real> grid;
    Real                spacing;
    const int          *starts;          ///< of the cells
    int                 first, n_moving; ///< identities of moving walls
    const int          *identities;
    Place<dim, Real>   *places;

    UNDINE_HOST_DEVICE
    void
    operator()(const int i) const
    {
      const Tag tag = places[i].tag;
      if (tag.is_free() || (tag.material() != 0 && !tag.is_inactive()))
        return;
      const Real near  = Real(0.75) * spacing;
      bool       taken = false;
      grid.for_each_run_around(
        places[i].x, [&](const int first_cell, const int end_cell, const Vector<dim, Real> &x) {
          for (int j = starts[first_cell]; j < starts[end_cell]; ++j)
            taken = taken || (is_moving(j) && norm_square(places[j].x - x) < near * near);
        });
      places[i].tag = Tag::of(tag.kind(), taken ? inactive_material : 0);
    }

  private:
    UNDINE_HOST_DEVICE
    bool
    is_moving(const int j) const
    {
      return identities[j] >= first && identities[j] < first + n_moving;
    }
  };


  /// The moving walls of a scene, where an executor works.
  template <class Executor, int dim, class Real>
  class MovingWalls
  {
  public:
    /// Their identities are `first` and those that follow.
    MovingWalls(Executor                   &executor,
                const Constants<dim, Real> &constants,
                const int                   first,
                const int                   n)
      : executor(executor)
      , grid(constants.grid)
      , spacing(constants.spacing)
      , first(first)
      , paths(executor, n)
    {
    }

    /// For a frame.
    void
    set_paths(const WallPaths<dim> &values)
    {
      std::vector<WallPath<dim, Real>> result;
      for (const auto &path : values)
        result.push_back({converted<dim, Real>(path.start),
                          converted<dim, Real>(path.way),
                          converted<dim, Real>(path.v_start),
                          converted<dim, Real>(path.v_end),
                          path.kind});
      if (!result.empty())
        paths.set(result);
    }

    /// To the end of a sub-step.
    void
    move(const Particles<dim, Real> &particles, StepControl *control) const
    {
      if (paths.size() > 0)
        executor.for_each(particles.n,
                          MoveWalls<dim, Real>{grid,
                                               paths.data(),
                                               first,
                                               particles.identities,
                                               particles.places,
                                               particles.motions,
                                               control});
    }

    /// Among the other walls, after a sort.
    void
    take_room(const Particles<dim, Real> &particles, const int *cell_starts) const
    {
      const int n = static_cast<int>(paths.size());
      if (n > 0)
        executor.for_each(
          particles.n,
          DeactivateWalls<dim, Real>{
            grid, spacing, cell_starts, first, n, particles.identities, particles.places});
    }

  private:
    Executor                             &executor;
    CellGrid<dim, Real>                   grid;
    Real                                  spacing;
    int                                   first;
    Buffer<Executor, WallPath<dim, Real>> paths; ///< of this frame
  };


  /// The fastest of them in a frame of this length [m/s], at least.
  template <int dim>
  double
  fastest(const WallPaths<dim> &paths, const double frame)
  {
    double square = 0;
    for (const auto &path : paths)
      square = maximum(maximum(square, norm_square(path.way) / (frame * frame)),
                       maximum(norm_square(path.v_start), norm_square(path.v_end)));
    return sqrt(square);
  }
} // namespace undine::particles

#endif
