// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/driver/size_check.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace undine
{
  namespace
  {
    constexpr double checkpoints = 3; // two slots, and the one that is being written


    /// Of what each rank has, the part that the run needs [1].
    double
    share_of_room(const Estimate &needed, const Room &room, const unsigned int n_ranks)
    {
      return needed.growth_of_rank(n_ranks) / std::max(room.bytes, 1.);
    }
  } // namespace


  template <int dim>
  SizeCheck
  SizeCheck::of(const Options &options, const MPI_Comm communicator)
  {
    SizeCheck check;
    check.n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
    check.room    = free_memory_of_each_rank(communicator);
    try
      {
        check.size   = measure_scene<dim>(options);
        check.needed = estimate(*check.size, check.n_ranks);
      }
    catch (const Error &)
      {
        check.size.reset(); // the same mistake is found, with all others, where the scene is read
      }
    return check;
  }


  bool
  SizeCheck::may_be_too_large() const
  {
    return size && share_of_room(needed, room, n_ranks) * Estimate::uncertainty_of_memory > 1;
  }


  std::string
  SizeCheck::lack_of_memory() const
  {
    const double share = share_of_room(needed, room, n_ranks);
    std::string  text  = fmt::format("about {} of memory {} needed, and there {} {} free",
                                   readable_bytes(needed.memory),
                                   n_ranks == 1 ? "is" : fmt::format("on {} ranks are", n_ranks),
                                   "is",
                                   readable_bytes(room.bytes * n_ranks));
    text += fmt::format(", by {}", room.by);
    if (size->grid.cells > 0)
      text += fmt::format(". About {:.2g} cells fit", size->grid.cells / share);
    else
      text += fmt::format(
        ". About {:.2g} of {} fit",
        (size->particles.all() > 0 ? size->particles.all() : size->solid.unknowns) / share,
        size->particles.all() > 0 ? "the particles" : "the bodies' unknowns");
    return text;
  }


  void
  SizeCheck::refuse_what_is_too_large() const
  {
    if (size && share_of_room(needed, room, n_ranks) > Estimate::uncertainty_of_memory)
      throw InputError("the scene is too large for this machine: " + lack_of_memory() +
                       ".\n  Try: fewer cells, elements or particles, or more machines.");
  }


  void
  SizeCheck::print(Log &log, const std::filesystem::path &folder) const
  {
    if (!size)
      return;
    log.print("size: {}", describe(*size));
    log.print(
      "estimate: {} of memory (within a factor of {}), {} a step (within {}), {} for {:.0f} "
      "step(s)",
      readable_bytes(needed.memory),
      Estimate::uncertainty_of_memory,
      readable_seconds(needed.seconds),
      needed.uncertainty_of_seconds,
      readable_seconds(needed.seconds * size->steps),
      size->steps);
    if (may_be_too_large())
      log.print("warning: memory may not suffice: {}.", lack_of_memory());
    const auto   disk    = free_disk(folder);
    const double results = size->pictures * needed.picture + checkpoints * needed.checkpoint;
    if (results > disk.bytes)
      log.print("warning: results take about {} ({:.0f} pictures of {}, checkpoints of {}), and "
                "there is {} free, by {}.",
                readable_bytes(results),
                size->pictures,
                readable_bytes(needed.picture),
                readable_bytes(needed.checkpoint),
                readable_bytes(disk.bytes),
                disk.by);
  }


  std::string
  readable_bytes(const double bytes)
  {
    if (bytes < 1000)
      return fmt::format("{:.0f} B", bytes);
    const std::array<const char *, 5> units{{"kB", "MB", "GB", "TB", "PB"}};
    double                            number = bytes / 1000;
    unsigned int                      unit   = 0;
    for (; number >= 1000 && unit + 1 < units.size(); ++unit)
      number /= 1000;
    return fmt::format("{:.{}f} {}", number, number < 10 ? 1 : 0, units[unit]);
  }


  std::string
  readable_seconds(const double seconds)
  {
    if (seconds < 100)
      return fmt::format("{:.2g} s", seconds);
    if (seconds < 6000)
      return fmt::format("{:.0f} min", seconds / 60);
    if (seconds < 100 * 3600)
      return fmt::format("{:.1f} h", seconds / 3600);
    return fmt::format("{:.0f} d", seconds / 86400);
  }


  template SizeCheck
  SizeCheck::of<2>(const Options &, MPI_Comm);
  template SizeCheck
  SizeCheck::of<3>(const Options &, MPI_Comm);
} // namespace undine
