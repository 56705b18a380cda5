// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/checkpoint/account_array.h>
#include <undine/output/checkpoint/budget_array.h>
#include <undine/output/checkpoint/checkpoint.h>
#include <undine/output/checkpoint/geometry_arrays.h>
#include <undine/output/checkpoint/impulses_array.h>
#include <undine/output/checkpoint/particle_arrays.h>
#include <undine/output/checkpoint/state_arrays.h>
#include <undine/output/files/files.h>
#include <undine/output/files/hdf5_reader.h>
#include <undine/output/files/hdf5_writer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace undine
{
  namespace
  {
    namespace fs = std::filesystem;

    // Version 1 has no geometry and no digest of statistics; before version 6 the nodes of bodies'
    // surfaces were those of the finite elements.
    constexpr std::uint64_t format_version = 7;


    /// What the rates of bodies mean, by a number.
    template <int dim>
    std::uint64_t
    kind_of_rates(const Models<dim> &models)
    {
      return models.solid ? models.solid->numerics().integrator->kind_of_rates() : 0;
    }


    std::array<fs::path, 2>
    slots(const fs::path &directory)
    {
      const auto files = checkpoint_files();
      return {{directory / files[0], directory / files[1]}};
    }


    /// The step of a slot that seems complete, or why it is not. One rank.
    struct Inspection
    {
      std::uint64_t step = 0;
      std::string   problem;
    };


    Inspection
    inspect(const fs::path &slot)
    {
      Inspection result;
      if (!fs::exists(slot))
        {
          result.problem = "'" + slot.string() + "' does not exist";
          return result;
        }
      try
        {
          const HDF5Reader file(slot, MPI_COMM_SELF);
          if (file.attribute<std::uint64_t>("format") > format_version)
            result.problem = "'" + slot.string() + "' is of another version of Undine";
          result.step = file.attribute<std::uint64_t>("step");
        }
      catch (const FileError &error)
        {
          result.problem = error.what();
        }
      return result;
    }


    /// A number that changes if any value is changed or moved, whichever ranks the values are on:
    /// the sum of a hash of every value with its place in the whole array.
    std::uint64_t
    checksum(const StateArray &array, const MPI_Comm communicator)
    {
      const auto   &box = array.selection;
      std::uint64_t sum = 0;
      for (std::size_t i = 0; i < array.values.size(); ++i)
        {
          std::uint64_t place = 0, stride = 1, rest = i, bits;
          for (std::size_t d = box.size.size(); d-- > 0;)
            {
              place += (box.offset[d] + rest % box.count[d]) * stride;
              rest /= box.count[d];
              stride *= box.size[d];
            }
          std::memcpy(&bits, &array.values[i], sizeof(bits));
          // Multiplication by odd constants and shifts: the finalizer of MurmurHash3 [A. Appleby].
          std::uint64_t hash = bits ^ (place * 0x9E3779B97F4A7C15u);
          hash               = (hash ^ (hash >> 33)) * 0xFF51AFD7ED558CCDu;
          hash               = (hash ^ (hash >> 33)) * 0xC4CEB9FE1A85EC53u;
          sum += hash ^ (hash >> 33);
        }
      return dealii::Utilities::MPI::sum(sum, communicator);
    }


    std::string
    checksum_name(const StateArray &array)
    {
      return "checksum of " + array.name;
    }


    void
    assert_finite(const std::vector<StateArray> &arrays, const MPI_Comm communicator)
    {
      for (const auto &array : arrays)
        {
          const bool finite = std::all_of(array.values.begin(),
                                          array.values.end(),
                                          [](const double value) { return std::isfinite(value); });
          if (dealii::Utilities::MPI::min(finite ? 1 : 0, communicator) == 0)
            throw SolveError("'" + array.name +
                             "' holds a value that is not a number. No checkpoint of this state is "
                             "written; the one before is kept.");
        }
    }


    template <int dim>
    void
    write_slot(const fs::path                &slot,
               const Models<dim>             &models,
               const std::vector<StateArray> &arrays,
               const Clock                   &clock,
               const std::uint64_t            statistics_digest,
               const MPI_Comm                 communicator)
    {
      HDF5Writer file(slot, communicator);
      file.add_attribute("format", format_version);
      file.add_attribute("dimension", std::uint64_t(dim));
      file.add_attribute("step", std::uint64_t(clock.step));
      file.add_attribute("time", clock.time);
      file.add_attribute("longest step", clock.limit.longest);
      file.add_attribute("steps before a longer one", std::uint64_t(clock.limit.patience));
      file.add_attribute("steps of the longest", std::uint64_t(clock.limit.served));
      file.add_attribute("longest step is doubled", std::uint64_t(clock.limit.is_doubled));
      file.add_attribute("after fallback", std::uint64_t(clock.after_fallback));
      file.add_attribute("kind of rates", kind_of_rates(models));
      file.add_attribute("statistics digest",
                         dealii::Utilities::MPI::broadcast(communicator, statistics_digest));
      for (const auto &array : arrays)
        {
          file.add(array.name, array.selection, array.values);
          file.add_attribute(checksum_name(array), checksum(array, communicator));
        }
      file.commit();
    }


    /// Fill arrays, of which names and sizes are given.
    void
    read_arrays(std::vector<StateArray> &arrays,
                const HDF5Reader        &file,
                const fs::path          &slot,
                const MPI_Comm           communicator)
    {
      for (auto &array : arrays)
        {
          if (!file.contains(array.name))
            throw FileError("'" + slot.string() + "' has no '" + array.name +
                            "': it belongs to another scene");
          array.values = file.read<double>(array.name, array.selection);
          if (checksum(array, communicator) != file.attribute<std::uint64_t>(checksum_name(array)))
            throw FileError("'" + slot.string() + "' is damaged: '" + array.name +
                            "' is not what was written");
        }
    }


    /// Throws FileError if the grid or something that stands in it is not where it was.
    template <int dim>
    void
    assert_same_geometry(const Models<dim> &models,
                         const double       time,
                         const HDF5Reader  &file,
                         const fs::path    &slot)
    {
      const auto here  = geometry_arrays(models, time);
      auto       there = here;
      read_arrays(there, file, slot, models.communicator());
      const auto difference = geometry_difference(there, here, models.communicator());
      if (!difference.empty())
        throw FileError("'" + slot.string() + "' belongs to another geometry: " + difference +
                        " must be as they were when the run began. A changed geometry needs a run "
                        "of its own");
    }


    /// Where the run was. Earlier formats know less.
    void
    read_clock(Clock &clock, const HDF5Reader &file, const std::uint64_t version)
    {
      clock.step = file.attribute<std::uint64_t>("step");
      clock.time = file.attribute<double>("time");
      if (version >= 3)
        clock.limit.longest = file.attribute<double>("longest step");
      if (version < 4)
        return;
      clock.limit.patience   = file.attribute<std::uint64_t>("steps before a longer one");
      clock.limit.served     = file.attribute<std::uint64_t>("steps of the longest");
      clock.limit.is_doubled = file.attribute<std::uint64_t>("longest step is doubled");
      if (version >= 5)
        clock.after_fallback = file.attribute<std::uint64_t>("after fallback");
    }


    /// Take out the rates that the slot does not have, of scalars that only the flow has changed so
    /// far: there are none yet.
    template <int dim>
    std::map<std::string, Field<dim>>
    take_out(std::map<std::string, Field<dim>> &rates, const HDF5Reader &file)
    {
      std::map<std::string, Field<dim>> result;
      for (auto rate = rates.begin(); rate != rates.end();)
        if (const auto now = rate++; !file.contains(scalar_rates_array + now->first))
          result.insert(rates.extract(now));
      return result;
    }


    /// Loads and rates that a run may have or not become those that the slot has, yet to be read.
    template <int dim>
    void
    expect_loads_of(State<dim> &state, const Models<dim> &models, const HDF5Reader &file)
    {
      if (is_in_use(state.fluid.volume_rates) && !file.contains(volume_rate_time_array))
        state.fluid.volume_rates = {}; // of a run with another form of convection
      if (state.solid.fluid_loads.size() > 0 && !file.contains(fluid_loads_array))
        state.solid.fluid_loads.clear(); // written by an earlier version
      if (models.solid && file.contains(contact_forces_array))
        state.solid.contact_forces = models.solid->vector();
      if (!file.contains(impulse_acceleration_array))
        state.solid.impulse_acceleration.clear(); // of another integrator, or an earlier version
      else if (models.solid)
        state.solid.impulse_acceleration = models.solid->vector();
    }


    /// They belong to another integrator.
    template <int dim>
    void
    forget_rates(State<dim> &state)
    {
      state.clock.after_fallback = true;
      state.solid.contact_forces.clear();
      state.solid.impulse_acceleration.clear();
    }


    /// `state` with the values, the time and the step of a slot.
    template <int dim>
    State<dim>
    read_slot(State<dim> state, const Models<dim> &models, const fs::path &slot)
    {
      const MPI_Comm   communicator = models.communicator();
      const HDF5Reader file(slot, communicator);
      if (file.attribute<std::uint64_t>("dimension") != dim)
        throw FileError("'" + slot.string() + "' is not of " + std::to_string(dim) +
                        " dimensions, as the scene is");
      const auto version = file.attribute<std::uint64_t>("format");
      read_clock(state.clock, file, version);
      if (version >= 2)
        assert_same_geometry(models, state.clock.time, file, slot);
      if (version < 6 && models.surface && models.solid)
        throw FileError("'" + slot.string() +
                        "' was written by an earlier version of the program, in which the "
                        "surfaces of bodies in a fluid had other nodes. Try: go on with that "
                        "version, or start the run anew");

      const auto lasting = count_lasting_particles(state.particles); // of the scene
      if (models.particles)
        resize_particles(state.particles, models.particles->setup().spacing, file);
      expect_loads_of(state, models, file);
      auto surface = pack_surface(models, state);
      read_arrays(surface, file, slot, communicator);
      unpack_surface(state, models, surface);
      if (!file.contains("history/numbers"))
        state.history = {}; // written by a run of constant steps: the scheme starts a new one
      if (!file.contains("sleep") ||
          file.size("sleep")[0] != pack_sleep(state.sleep, communicator).selection.size[0])
        state.sleep = {}; // of a run without sleep, or of an earlier version: all are awake
      const auto n_rates = pack_budget(state.budget_rates, communicator).selection.size[0];
      if (!file.contains(budget_array) || file.size(budget_array)[0] != n_rates)
        state.budget_rates = {}; // of a run without a budget, or with other effects
      const bool is_monitored = state.account.has_value();
      if (!file.contains(account_array) ||
          (is_monitored && file.size(account_array)[0] !=
                             pack_account(*state.account, communicator).selection.size[0]))
        state.account.reset();
      const auto no_impulses = state.impulses;
      if (no_impulses && (!file.contains(impulses_array) ||
                          file.size(impulses_array)[0] !=
                            pack_impulses(*no_impulses, communicator).selection.size[0]))
        state.impulses.reset(); // of a run without them, or with other bodies
      auto rates_at_rest = take_out(state.fluid.scalar_rates, file);
      auto arrays        = pack(models, state);
      read_arrays(arrays, file, slot, communicator);
      unpack(state, models, arrays);
      if (!rates_at_rest.empty())
        state.clock.after_fallback = true; // stages have no rates to go on with, as at the start
      state.fluid.scalar_rates.merge(rates_at_rest);
      if (version >= 7 && file.attribute<std::uint64_t>("kind of rates") != kind_of_rates(models))
        forget_rates(state);
      if (is_monitored && !state.account)
        // Of a run without a monitor: nothing is known yet.
        state.account.emplace().energy = std::numeric_limits<double>::quiet_NaN();
      if (!state.impulses)
        state.impulses = no_impulses;
      if (count_lasting_particles(state.particles) != lasting)
        throw FileError("'" + slot.string() +
                        "' has more or fewer particles of bodies and walls than the scene: it "
                        "belongs to another one");
      return state;
    }


    /// Numbers of the slots that seem complete, the newest first; adds why the others do not.
    std::vector<unsigned int>
    candidates(std::vector<std::string> &problems,
               const fs::path           &directory,
               const MPI_Comm            communicator)
    {
      std::vector<std::pair<std::uint64_t, unsigned int>> found; // step, slot
      if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
        for (const unsigned int s : {0, 1})
          {
            const auto result = inspect(slots(directory)[s]);
            if (result.problem.empty())
              found.emplace_back(result.step, s);
            else
              problems.push_back(result.problem);
          }
      std::sort(found.rbegin(), found.rend());
      problems = dealii::Utilities::MPI::broadcast(communicator, problems);
      std::vector<unsigned int> numbers;
      for (const auto &slot : dealii::Utilities::MPI::broadcast(communicator, found))
        numbers.push_back(slot.second);
      return numbers;
    }
  } // namespace


  std::array<fs::path, 2>
  checkpoint_files()
  {
    return {{fs::path("checkpoint") / "slot_0.h5", fs::path("checkpoint") / "slot_1.h5"}};
  }


  std::uint64_t
  resumable_step(const fs::path &directory)
  {
    std::uint64_t step = 0;
    for (const auto &slot : slots(directory))
      step = std::max(step, inspect(slot).step);
    return step;
  }


  template <int dim>
  void
  write_checkpoint(const fs::path     &directory,
                   const Models<dim>  &models,
                   const State<dim>   &state,
                   const std::uint64_t statistics_digest)
  {
    const MPI_Comm communicator = models.communicator();
    auto           arrays       = pack_surface(models, state);
    for (auto &array : pack(models, state))
      arrays.push_back(std::move(array));
    assert_finite(arrays, communicator);
    for (auto &array : geometry_arrays(models, state.clock.time))
      arrays.push_back(std::move(array));
    on_first_rank(communicator, [&] {
      make_folder(directory / "checkpoint");
      // The checkpoint knows its rows: a machine that stops must not keep one without them.
      if (const auto statistics = directory / "statistics"; fs::exists(statistics))
        reach_disk(statistics);
    });

    std::vector<std::string> problems;
    const auto               whole = candidates(problems, directory, communicator);
    const unsigned int       older = whole.empty() ? 0 : 1 - whole.front();
    write_slot(
      slots(directory)[older], models, arrays, state.clock, statistics_digest, communicator);
  }


  template <int dim>
  ResumedFrom
  read_checkpoint(const fs::path &directory, const Models<dim> &models, State<dim> &state)
  {
    const MPI_Comm communicator = models.communicator();
    ResumedFrom    result;
    result.directory = directory;
    for (const unsigned int s : candidates(result.skipped, directory, communicator))
      try
        {
          state       = read_slot(state, models, slots(directory)[s]);
          result.slot = slots(directory)[s];
          const HDF5Reader file(result.slot, communicator);
          if (file.attribute<std::uint64_t>("format") >= 2)
            result.statistics_digest = file.attribute<std::uint64_t>("statistics digest");
          return result;
        }
      catch (const FileError &error)
        {
          result.skipped.push_back(error.what());
        }
    std::string reasons;
    for (const auto &reason : result.skipped)
      reasons += "\n  " + reason;
    throw FileError("there is no checkpoint in '" + directory.string() +
                    "' that this scene can be resumed from:" + reasons);
  }


  template void
  write_checkpoint(const fs::path &, const Models<2> &, const State<2> &, std::uint64_t);
  template void
  write_checkpoint(const fs::path &, const Models<3> &, const State<3> &, std::uint64_t);
  template ResumedFrom
  read_checkpoint(const fs::path &, const Models<2> &, State<2> &);
  template ResumedFrom
  read_checkpoint(const fs::path &, const Models<3> &, State<3> &);
} // namespace undine
