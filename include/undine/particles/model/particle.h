// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_model_particle_h
#define undine_particles_model_particle_h

#include <undine/particles/math/vector.h>

#include <cstdint>

namespace undine::particles
{
  /// What a particle stands for.
  enum class Kind : std::int32_t
  {
    fluid = 0,
    solid = 1, ///< of an elastic body
    wall  = 2, ///< first layer of a wall: has a pressure
    dummy = 3  ///< deeper layers, which only fill the neighbourhood of wall and fluid
  };

  /// Materials that have the fluid's density like material 0, the fluid and fixed walls; those of
  /// bodies are 1, 2, ... @{
  constexpr int inflow_material   = -1; ///< of the layers behind inflows
  constexpr int parked_material   = -2; ///< of what waits outside of space to flow in
  constexpr int moving_material   = -3; ///< of walls that move as prescribed
  constexpr int inactive_material = -4; ///< of fixed walls where a moving one is: count for nothing
  constexpr int opening_material  = -5; ///< of the layers behind openings that have a pressure
  /// @}

  /// Kind and material of a particle in one number.
  struct Tag
  {
    std::int32_t code;

    UNDINE_HOST_DEVICE
    static Tag
    of(const Kind kind, const int material)
    {
      return {static_cast<std::int32_t>(kind) + 4 * material};
    }

    /// Of a particle that waits outside of space to flow in.
    UNDINE_HOST_DEVICE
    static Tag
    parked()
    {
      return of(Kind::dummy, parked_material);
    }

    UNDINE_HOST_DEVICE
    bool
    is_parked() const
    {
      return code == parked().code;
    }

    UNDINE_HOST_DEVICE
    Kind
    kind() const
    {
      return static_cast<Kind>(code & 3);
    }

    /// Of bodies their number plus one.
    UNDINE_HOST_DEVICE
    int
    material() const
    {
      return code >> 2;
    }

    /// Of a fixed wall, in whose place a moving one is?
    UNDINE_HOST_DEVICE
    bool
    is_inactive() const
    {
      return material() == inactive_material;
    }

    /// Of the layers behind inflows and openings, which move along their normal?
    UNDINE_HOST_DEVICE
    bool
    is_in_layers() const
    {
      return material() == inflow_material || material() == opening_material;
    }

    /// Does it move as forces tell it?
    UNDINE_HOST_DEVICE
    bool
    is_free() const
    {
      return (code & 2) == 0;
    }
  };

  /// Where a particle is [m] and what it stands for. Read as one word of 16 bytes on the device.
  template <int dim, class Real>
  struct alignas(4 * sizeof(Real)) Place
  {
    Vector<dim, Real> x;
    Tag               tag;
  };

  /// How a particle moves [m/s] and its pressure [Pa].
  template <int dim, class Real>
  struct alignas(4 * sizeof(Real)) Motion
  {
    Vector<dim, Real> v;
    Real              pressure;
  };

  /// The particles, sorted by cells. Identities are unique; those of elastic bodies are
  /// 0 ... n_solid - 1, in the order of Elasticity.
  template <int dim, class Real>
  struct Particles
  {
    int                n;
    Place<dim, Real>  *places;
    Motion<dim, Real> *motions;
    int               *identities;
    /// Of the virtual faces, kept as a guess for the next sub-step.
    StoredVector<dim, Real> *potentials;
  };
} // namespace undine::particles

#endif
