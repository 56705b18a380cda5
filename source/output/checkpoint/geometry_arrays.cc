// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/checkpoint/geometry_arrays.h>

#include <cmath>

namespace undine
{
  namespace
  {
    /// Between -1 and 1, another one for every point: the finalizer of SplitMix64 [S. Vigna].
    double
    weight(std::uint64_t point)
    {
      point += 0x9E3779B97F4A7C15u;
      point = (point ^ (point >> 30)) * 0xBF58476D1CE4E5B9u;
      point = (point ^ (point >> 27)) * 0x94D049BB133111EBu;
      return std::ldexp(double(point ^ (point >> 31)), -63) - 1;
    }


    /// The sums over points, which are added one by one.
    class Sums
    {
    public:
      explicit Sums(const unsigned int n_directions)
        : values(2 + n_directions, 0.)
      {
      }

      template <class Place>
      void
      add(const Place &place)
      {
        const double w       = weight(values[0]++);
        double       squares = 0;
        for (unsigned int axis = 0; axis + 2 < values.size(); ++axis)
          {
            squares += place[axis] * place[axis];
            values[2 + axis] += w * place[axis];
          }
        values[1] += std::sqrt(squares);
      }

      StateArray
      array(const std::string &of, const MPI_Comm communicator) const
      {
        const bool    first = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
        const hsize_t count = first ? values.size() : 0;
        return {"geometry/" + of,
                {{values.size()}, {0}, {count}},
                std::vector<double>(values.begin(), values.begin() + count)};
      }

    private:
      std::vector<double> values;
    };
  } // namespace


  template <int dim>
  std::vector<StateArray>
  geometry_arrays(const Models<dim> &models, const double time)
  {
    std::vector<StateArray> result;
    const MPI_Comm          communicator = models.communicator();
    if (models.fluid)
      {
        Sums sums(1);
        for (unsigned int axis = 0; axis < dim; ++axis)
          for (const double plane : models.fluid->grid().planes(axis))
            sums.add(std::array<double, 1>{{plane}});
        result.push_back(sums.array("the grid of the fluid", communicator));
      }
    if (models.solid)
      {
        Sums sums(dim);
        for (const auto &vertex : models.solid->triangulation().get_vertices())
          sums.add(vertex);
        result.push_back(sums.array("the bodies at rest", communicator));
      }
    if (models.surface)
      {
        Sums sums(dim);
        for (const auto &node : models.surface->obstacles().positions(time))
          sums.add(node);
        result.push_back(sums.array("the obstacles at that time", communicator));
      }
    if (models.particles)
      {
        Sums        sums(dim);
        const auto &setup = models.particles->setup();
        sums.add(setup.lower);
        sums.add(setup.upper);
        for (const auto &place : setup.reference)
          sums.add(place);
        result.push_back(sums.array("the domain or the bodies at rest", communicator));
      }
    return result;
  }


  std::string
  geometry_difference(const std::vector<StateArray> &of_checkpoint,
                      const std::vector<StateArray> &of_scene,
                      const MPI_Comm                 communicator)
  {
    constexpr double rounding = 1e-10; // of the sums of |x|
    std::string      result;
    for (std::size_t k = 0; k < of_scene.size() && result.empty(); ++k)
      {
        const auto &there = of_checkpoint[k].values, &here = of_scene[k].values;
        for (std::size_t i = 0; i < here.size(); ++i)
          if (!(std::abs(there[i] - here[i]) <= rounding * here[1]) || there[0] != here[0])
            result = of_scene[k].name.substr(of_scene[k].name.find('/') + 1);
      }
    return dealii::Utilities::MPI::broadcast(communicator, result);
  }


  template std::vector<StateArray>
  geometry_arrays(const Models<2> &, double);
  template std::vector<StateArray>
  geometry_arrays(const Models<3> &, double);
} // namespace undine
