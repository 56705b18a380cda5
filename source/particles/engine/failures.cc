// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/particles/engine/failures.h>

#include <sstream>

namespace undine::particles
{
  namespace
  {
    bool
    has(const StepControl &control, const Failure failure)
    {
      return (control.failures & static_cast<unsigned int>(failure)) != 0;
    }
  } // namespace


  std::string
  reason_of_failure(const StepControl &control)
  {
    std::ostringstream text;
    text << "the particles' step failed " << control.elapsed << " s into the frame, in sub-step "
         << control.sub_steps << ": ";
    if (has(control, Failure::not_a_number))
      text << "a velocity is not a number. ";
    if (has(control, Failure::outside))
      text << "a particle left the room around the domain: it went through a wall, or a body went "
              "farther than 'Domain / Room beyond open sides'. ";
    if (has(control, Failure::neighbours))
      text << "particles crowd: one has more neighbours than the list can hold. ";
    if (has(control, Failure::matrix_indices))
      text << "neighbours are too far apart in memory. ";
    if (has(control, Failure::no_reserve))
      text << "more particles flow in than there is room for. ";
    if (has(control, Failure::crushed))
      text << "a body is crushed so hard that its elastic steps become too small. ";
    text << "The fastest particle moved at " << control.fastest
         << " m/s. Try a smaller 'Speed share', smaller particles, a more viscous fluid or a "
            "stiffer body.";
    return text.str();
  }
} // namespace undine::particles
