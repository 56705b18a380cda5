// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_pressure_swept_volume_flux_h
#define undine_fluid_pressure_swept_volume_flux_h

#include <string>
#include <vector>

namespace undine
{
  /// The swept-volume flux: what the surfaces of bodies and obstacles displace of the fluid.
  /// Components are those of FluidTopology::cells.
  struct SweptVolumeFlux
  {
    /// What one body contributes to the flux out of a component.
    struct Contribution
    {
      int          component;
      unsigned int body;
      double       flux; ///< [m^dim/s]
    };

    std::vector<double>       fluxes; ///< (B u)_c out of each component [m^dim/s]; empty: none
    std::vector<double>       uncertainties; ///< of these, by rounding [m^dim/s]
    std::vector<Contribution> contributions; ///< of which they are the sums
    std::vector<std::string>  bodies;        ///< what messages call them

    /// Area of the compliant surfaces around each component [m^(dim-1)]; empty: none is.
    std::vector<double> compliant_areas;

    std::string scene; ///< name of the file
  };
} // namespace undine

#endif
