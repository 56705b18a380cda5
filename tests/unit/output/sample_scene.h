// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_output_sample_scene_h
#define undine_tests_output_sample_scene_h

#include <undine/coupled/model/models.h>
#include <undine/coupled/state/state.h>
#include <undine/output/files/files.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <sys/resource.h>
#include <unistd.h>

namespace undine_tests
{
  using namespace undine;

  /// A folder that all ranks share and that is gone at the end of the test.
  class TemporaryFolder
  {
  public:
    TemporaryFolder()
    {
      static unsigned int number = 0;
      const std::string   name =
        "undine_output_" + std::to_string(getpid()) + "_" + std::to_string(number++);
      path = dealii::Utilities::MPI::broadcast(
        MPI_COMM_WORLD, (std::filesystem::temp_directory_path() / name).string());
      on_first_rank(MPI_COMM_WORLD, [&] { make_folder(path); });
    }

    ~TemporaryFolder()
    {
      MPI_Barrier(MPI_COMM_WORLD);
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }

    std::filesystem::path path;
  };


  /// Files may not grow beyond `bytes`, as on a disk that is nearly full.
  class FileSizeLimit
  {
  public:
    explicit FileSizeLimit(const rlim_t bytes)
      : old_action(std::signal(SIGXFSZ, SIG_IGN))
    {
      getrlimit(RLIMIT_FSIZE, &old_limit);
      const rlimit limit{bytes, old_limit.rlim_max};
      setrlimit(RLIMIT_FSIZE, &limit);
    }

    ~FileSizeLimit()
    {
      setrlimit(RLIMIT_FSIZE, &old_limit);
      std::signal(SIGXFSZ, old_action);
    }

  private:
    rlimit old_limit;
    void (*old_action)(int);
  };


  inline Options
  options_of(const std::string &text)
  {
    const std::string name =
      (std::filesystem::temp_directory_path() / ("scene_" + std::to_string(getpid()) + ".prm"))
        .string();
    std::ofstream(name) << text;
    const ParameterFile file(name);
    std::filesystem::remove(name);
    return Options(file);
  }


  /// "a, a, a"
  template <int dim>
  std::string
  repeated(const std::string &word)
  {
    std::string text = word;
    for (unsigned int axis = 1; axis < dim; ++axis)
      text += ", " + word;
    return text;
  }


  template <int dim>
  std::string
  sample_scene_text()
  {
    return "subsection Bodies\n"
           " subsection block\n  set Shape = box\n  set Lower corner = " +
           repeated<dim>("0") + "\n  set Upper corner = " + repeated<dim>("1") +
           "\n  set Cells = " + repeated<dim>("3") +
           "\n  set Density = 1000\n  set Material = neo-Hookean\n"
           "  set Young's modulus = 1e6\n  set Poisson's ratio = 0.3\n end\nend\n"
           "subsection Domain\n set Lower corner = " +
           repeated<dim>("0") + "\n set Upper corner = " + repeated<dim>("1") +
           "\n set Cells = " + repeated<dim>("5") +
           "\n set Grading x = (x + x^2)/2\nend\n"
           "subsection Fluid\n set Density = 1000\nend\n";
  }


  /// A displacement and a velocity that are linear in space, times `factor`. @{
  template <int dim>
  dealii::Tensor<1, dim>
  linear_displacement(const dealii::Point<dim> &place, const double factor = 1)
  {
    dealii::Tensor<1, dim> result;
    for (unsigned int axis = 0; axis < dim; ++axis)
      for (unsigned int other = 0; other < dim; ++other)
        result[axis] += factor * 0.01 * (1 + axis + 2 * other) * place[other];
    return result;
  }

  template <int dim>
  dealii::Tensor<1, dim>
  linear_velocity(const dealii::Point<dim> &place, const double factor = 1)
  {
    dealii::Tensor<1, dim> result;
    for (unsigned int axis = 0; axis < dim; ++axis)
      for (unsigned int other = 0; other < dim; ++other)
        result[axis] += factor * (1 + 3. * axis - other) * place[other] + factor;
    return result;
  }

  template <int dim>
  double
  linear_scalar(const dealii::Point<dim> &place, const double factor = 1)
  {
    double result = factor;
    for (unsigned int axis = 0; axis < dim; ++axis)
      result += factor * (axis + 1.) * place[axis];
    return result;
  }
  /// @}


  /// A body and a fluid that never step: states are written by hand.
  template <int dim>
  struct SampleScene
  {
    explicit SampleScene(const MPI_Comm communicator)
    {
      const auto options = options_of(sample_scene_text<dim>());
      models.solid       = std::make_unique<const SolidModel<dim>>(options, communicator);
      models.fluid       = std::make_unique<const FluidModel<dim>>(options, communicator);
    }

    State<dim>
    zero_state() const
    {
      State<dim> state;
      state.solid.displacement = models.solid->vector();
      state.solid.velocity     = models.solid->vector();
      state.solid.acceleration = models.solid->vector();
      state.fluid              = models.fluid->initial_state();
      state.fluid.pressure     = Field<dim>(models.fluid->grid().cells());
      for (const auto &name : {"smoke", "temperature"})
        state.fluid.scalars.emplace(name, Field<dim>(models.fluid->grid().cells()));
      return state;
    }

    State<dim>
    linear_state(const double factor = 1) const
    {
      auto        state = zero_state();
      const auto &solid = *models.solid;
      for (const auto dof : solid.locally_owned())
        {
          const auto place              = solid.rest_position(dof);
          const auto axis               = solid.axis(dof);
          state.solid.displacement(dof) = linear_displacement(place, factor)[axis];
          state.solid.velocity(dof)     = linear_velocity(place, factor)[axis];
          state.solid.acceleration(dof) = factor * dim + place[axis] / 3;
        }
      for (auto *vector :
           {&state.solid.displacement, &state.solid.velocity, &state.solid.acceleration})
        vector->compress(dealii::VectorOperation::insert);
      for (unsigned int axis = 0; axis < dim; ++axis)
        fill(state.fluid.velocity[axis],
             [&](const auto &place) { return linear_velocity<dim>(place, factor)[axis]; });
      fill(state.fluid.pressure,
           [&](const auto &place) { return linear_scalar<dim>(place, factor); });
      for (auto &scalar : state.fluid.scalars)
        fill(scalar.second, [&](const auto &place) {
          return linear_scalar<dim>(place, factor * double(scalar.first.size()));
        });
      return state;
    }

    /// The largest difference between two states.
    static double
    difference(const State<dim> &one, const State<dim> &two)
    {
      double     result  = 0;
      const auto compare = [&](const auto &a, const auto &b) {
        auto d = a;
        d -= b;
        result = std::max(result, double(d.linfty_norm()));
      };
      compare(one.solid.displacement, two.solid.displacement);
      compare(one.solid.velocity, two.solid.velocity);
      compare(one.solid.acceleration, two.solid.acceleration);
      const auto compare_fields = [&](const Field<dim> &a, const Field<dim> &b) {
        for_each(a.owned(), [&](const auto &index) {
          result = std::max(result, std::abs(a(index) - b(index)));
        });
      };
      for (unsigned int axis = 0; axis < dim; ++axis)
        compare_fields(one.fluid.velocity[axis], two.fluid.velocity[axis]);
      compare_fields(one.fluid.pressure, two.fluid.pressure);
      for (const auto &scalar : one.fluid.scalars)
        compare_fields(scalar.second, two.fluid.scalars.at(scalar.first));
      return dealii::Utilities::MPI::max(result, MPI_COMM_WORLD);
    }

    Models<dim> models;

  private:
    template <class Function>
    static void
    fill(Field<dim> &field, const Function &function)
    {
      for_each(field.owned(),
               [&](const auto &index) { field(index) = function(field.lattice().point(index)); });
    }
  };
} // namespace undine_tests

#endif
