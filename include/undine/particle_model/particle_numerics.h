// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particle_model_particle_numerics_h
#define undine_particle_model_particle_numerics_h

#include <undine/base/options/options.h>
#include <undine/particles/engine/engine.h>

#include <string>

namespace undine
{
  /// The section `Particles`: how particles are computed, and where.
  struct ParticleNumerics
  {
    /// Read it. Throws InputError.
    explicit ParticleNumerics(const Options &scene);

    double               spacing   = 1;      ///< l0 [m]
    std::string          executor  = "host"; ///< name of the engine's factory
    unsigned int         device    = 0;      ///< number of the graphics card
    particles::Precision precision = particles::Precision::single_precision;
    particles::Numerics  numerics;

  private:
    void
    read_machine(const Options &options);
    void
    read_sub_steps(const Options &options);
    void
    read_pressure(const Options &options);
    void
    read_solver(const Options &options);
    void
    read_free_surface(const Options &options);
    void
    read_order(const Options &options);
  };
} // namespace undine

#endif
