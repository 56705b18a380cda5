// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_scene_scene_size_h
#define undine_scene_scene_size_h

#include <undine/base/options/options.h>

namespace undine
{
  /// A fluid on a grid, with the surfaces in it.
  struct GridSize
  {
    double       cells        = 0;     ///< 0: there is no grid
    unsigned int advected     = 0;     ///< fields that the flow advects
    unsigned int implicit     = 0;     ///< fields for which a linear system is solved
    unsigned int scalars      = 0;     ///< fields besides velocity and pressure
    double       cut_cells    = 0;     ///< cells that surfaces go through
    double       facets       = 0;     ///< of these surfaces
    bool         has_openings = false; ///< boundaries through which pressure lets fluid flow
    bool         moves        = false; ///< something that stands in it does
  };

  /// Bodies of finite elements.
  struct SolidSize
  {
    double       elements = 0; ///< 0: there are none
    unsigned int degree   = 0;
    double       unknowns = 0; ///< components of velocity
    double       entries  = 0; ///< of the tangent matrix that are not zero
    double       work     = 0; ///< unknowns times the square of those in a slice, see
                               ///< factorisation_work()
    bool is_direct = false;    ///< the tangent is factorised
  };

  /// Fluid and bodies of particles.
  struct ParticleSize
  {
    double fluid         = 0;
    double solid         = 0;
    double walls         = 0;     ///< also those that move
    double waiting       = 0;     ///< to flow in; a state does not count them
    double grid_cells    = 0;     ///< of the grid by which neighbours are found
    double sub_steps     = 0;     ///< of a frame with fluid
    double elastic_steps = 0;     ///< of bodies in a frame
    bool   is_double     = false; ///< precision
    bool   on_device     = false; ///< the memory is that of a device

    double
    all() const
    {
      return fluid + solid + walls + waiting;
    }
  };

  /// The size of a scene, by its parameter file alone: counts, which are approximate where shapes
  /// are curved or mapped or regions are expressions.
  struct SceneSize
  {
    unsigned int dimension = 0;
    double       steps     = 0; ///< of the run; 0: unknown
    double       pictures  = 0; ///< output times
    unsigned int stages    = 1; ///< of a step
    GridSize     grid;
    SolidSize    solid;
    ParticleSize particles;
    bool         is_coupled  = false; ///< fluid and bodies are solved together
    bool         has_contact = false; ///< bodies may touch
  };

  /// Read a parameter file for it; nothing is built but the meshes of curved shapes before their
  /// refinement and surfaces from files. Throws InputError for some of the mistakes that
  /// read_scene() reports, FileError. Leaves `options` as they are.
  template <int dim>
  SceneSize
  measure_scene(const Options &options);
} // namespace undine

#endif
