// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/surface/shape_boundary.h>

#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/tria.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

namespace undine
{
  namespace
  {
    /// Collects facets by the places of their corners; corners at one place are one node.
    template <int dim>
    class FacetCollector
    {
    public:
      void
      add(const std::array<dealii::Point<dim>, dim> &corners)
      {
        typename Surface<dim>::Facet facet;
        for (unsigned int k = 0; k < dim; ++k)
          {
            std::array<double, dim> place;
            for (unsigned int axis = 0; axis < dim; ++axis)
              place[axis] = corners[k][axis] + 0.; // one sign of zero
            const auto found = numbers.emplace(place, boundary.nodes.size());
            if (found.second)
              boundary.nodes.push_back(corners[k]);
            facet[k] = found.first->second;
          }
        // Programs write slivers whose corners rounding has joined: without them it still closes.
        for (unsigned int k = 0; k < dim; ++k)
          if (facet[k] == facet[(k + 1) % dim])
            return;
        boundary.facets.push_back(facet);
        boundary.sides.push_back(0);
      }

      ShapeBoundary<dim> boundary;

    private:
      std::map<std::array<double, dim>, unsigned int> numbers;
    };


    /// Numbers of a binary file, which are little-endian, as is every machine that this runs on.
    template <class Number>
    Number
    number_at(const std::string &bytes, const std::size_t place)
    {
      Number result;
      std::memcpy(&result, bytes.data() + place, sizeof(result));
      return result;
    }


    bool
    is_binary_stl(const std::string &bytes)
    {
      return bytes.size() >= 84 && bytes.size() == 84 + 50ull * number_at<std::uint32_t>(bytes, 80);
    }


    /// 80 bytes of text, the number of triangles, then for each a normal, three corners and two
    /// bytes.
    void
    read_binary_stl(FacetCollector<3> &collector, const std::string &bytes)
    {
      for (std::size_t triangle = 84; triangle + 50 <= bytes.size(); triangle += 50)
        {
          std::array<dealii::Point<3>, 3> corners;
          for (unsigned int k = 0; k < 3; ++k)
            for (unsigned int axis = 0; axis < 3; ++axis)
              corners[k][axis] = number_at<float>(bytes, triangle + 12 + 12 * k + 4 * axis);
          collector.add(corners);
        }
    }


    void
    read_text_stl(FacetCollector<3> &collector, const std::string &text)
    {
      std::istringstream              in(text);
      std::string                     word;
      std::array<dealii::Point<3>, 3> corners;
      unsigned int                    corner = 0;
      while (in >> word)
        if (word == "vertex" &&
            in >> corners[corner][0] >> corners[corner][1] >> corners[corner][2])
          {
            if (++corner == 3)
              collector.add(corners);
            corner %= 3;
          }
    }


    /// True if the file was one of STL, and has been read.
    bool
    read_stl(FacetCollector<3> &collector, const std::string &bytes)
    {
      if (is_binary_stl(bytes))
        read_binary_stl(collector, bytes);
      else if (bytes.compare(0, 5, "solid") == 0)
        read_text_stl(collector, bytes);
      else
        return false;
      return true;
    }


    bool
    read_stl(FacetCollector<2> &, const std::string &)
    {
      return false; // its triangles lie in space
    }


    /// Quadrilaterals become two triangles.
    template <int dim>
    void
    read_gmsh(FacetCollector<dim> &collector, const std::string &text)
    {
      dealii::Triangulation<dim - 1, dim> mesh;
      dealii::GridIn<dim - 1, dim>        reader(mesh);
      std::istringstream                  in(text);
      reader.read_msh(in);
      for (const auto &cell : mesh.active_cell_iterators())
        for (unsigned int first = 0; first + dim <= cell->n_vertices(); ++first)
          {
            std::array<dealii::Point<dim>, dim> corners;
            for (unsigned int k = 0; k < dim; ++k)
              corners[k] = cell->vertex(first + k);
            if (first == 1) // a quadrilateral's vertices run along its rows
              std::swap(corners[0], corners[1]);
            collector.add(corners);
          }
    }


    template <int dim>
    void
    turn_outwards(ShapeBoundary<dim> &boundary)
    {
      if (body_volumes(boundary.surface(""), boundary.nodes)[0] < 0)
        for (auto &facet : boundary.facets)
          std::swap(facet[0], facet[1]);
    }


    /// Throws InputError, without the place in the scene.
    template <int dim>
    ShapeBoundary<dim>
    parse(const std::string &bytes, const double scale)
    {
      FacetCollector<dim> collector;
      if (!read_stl(collector, bytes))
        try
          {
            read_gmsh(collector, bytes);
          }
        catch (const std::exception &)
          {
            throw InputError("is neither an STL file nor a surface mesh of Gmsh");
          }
      auto &boundary = collector.boundary;
      if (boundary.facets.empty())
        throw InputError("holds no facet of a surface");
      for (auto &node : boundary.nodes)
        node *= scale;
      check_closed(boundary.surface("surface"), boundary.nodes);
      turn_outwards(boundary);
      if (!(body_volumes(boundary.surface(""), boundary.nodes)[0] > 0))
        throw InputError("encloses no volume");
      return boundary;
    }
  } // namespace


  template <int dim>
  ShapeBoundary<dim>
  read_surface_file(const Options &options, const std::string &file, const double scale)
  {
    const auto    path = options.file().folder() / file;
    std::ifstream in(path, std::ios::binary);
    if (!in || !std::filesystem::is_regular_file(path))
      throw options.error("Surface",
                          "'" + path.string() + "' cannot be read",
                          "Try: a path relative to the folder of the scene's file.");
    const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    try
      {
        return parse<dim>(bytes, scale);
      }
    catch (const InputError &reason)
      {
        throw options.error("Surface",
                            "'" + path.string() + "': " + reason.what(),
                            "Allowed: a closed surface without branches, as STL (3D) or as Gmsh's "
                            "triangles (3D) or lines (2D).");
      }
  }


  template ShapeBoundary<2>
  read_surface_file<2>(const Options &, const std::string &, const double);
  template ShapeBoundary<3>
  read_surface_file<3>(const Options &, const std::string &, const double);
} // namespace undine
