// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/registry.h>
#include <undine/solid/mesh/body_shape.h>

#include <deal.II/grid/grid_in.h>

#include <filesystem>
#include <fstream>

namespace undine
{
  /// A mesh from a file of Gmsh.
  template <int dim>
  class Gmsh : public BodyShape<dim>
  {
  public:
    void
    add_options(const Options &options) override
    {
      section = std::make_unique<Options>(options);
      options.require("File",
                      file,
                      "",
                      Allowed::anything(),
                      "Mesh of quadrilaterals (2D) or hexahedra (3D), lengths in m; the path is "
                      "relative to the scene's file.");
      options.add("Scale", scale, "1", Allowed::positive(), "Factor on all lengths in the file.");
    }

    void
    make_mesh(dealii::Triangulation<dim> &mesh) const override
    {
      const auto    folder = section->file().folder();
      const auto    path   = folder / file;
      std::ifstream in(path);
      if (!in || !std::filesystem::is_regular_file(path))
        throw section->error("File",
                             "'" + path.string() + "' cannot be read",
                             "Try: a path relative to the folder of the scene's file.");
      try
        {
          dealii::GridIn<dim> reader(mesh);
          reader.read_msh(in);
        }
      catch (const std::exception &)
        {
          throw not_a_mesh(path.string());
        }
      if (mesh.n_active_cells() == 0 || !mesh.all_reference_cells_are_hyper_cube())
        throw not_a_mesh(path.string());
      dealii::GridTools::scale(scale, mesh);
    }

    typename BodyShape<dim>::Sides
    sides(const dealii::Triangulation<dim> &mesh) const override
    {
      typename BodyShape<dim>::Sides result;
      for (const auto id : mesh.get_boundary_ids())
        result[std::to_string(id)] = id;
      return result;
    }

  private:
    InputError
    not_a_mesh(const std::string &path) const
    {
      return section->error(
        "File",
        "'" + path + "' is not a Gmsh mesh of quadrilaterals or hexahedra",
        "Allowed: Gmsh's MSH format, ASCII, version 2 to 4.1; sides are named by "
        "the numbers of the physical groups (Recombine makes quadrilaterals).");
    }

    std::unique_ptr<Options> section;
    std::string              file;
    double                   scale = 1;
  };


  static const RegisterForDimensions<BodyShape, Gmsh>
    gmsh("gmsh", "A mesh file of Gmsh; sides are named by the numbers of its physical groups.");
} // namespace undine
