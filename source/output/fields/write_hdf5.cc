// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/fields/patches.h>
#include <undine/output/files/hdf5_writer.h>

#include <algorithm>

namespace undine
{
  namespace
  {
    /// Where this rank's rows lie among those of all.
    struct Rows
    {
      std::uint64_t total;
      std::uint64_t first;
      std::uint64_t mine;

      Rows(const std::uint64_t mine, const MPI_Comm communicator)
        : total(dealii::Utilities::MPI::sum(mine, communicator))
        , mine(mine)
      {
        MPI_Scan(&mine, &first, 1, MPI_UINT64_T, MPI_SUM, communicator);
        first -= mine;
      }

      /// As an array with `columns` numbers a row.
      Selection
      of_columns(const hsize_t columns) const
      {
        return {{total, columns}, {first, 0}, {mine, columns}};
      }
    };


    /// Fields in the order in which DataOutFilter has them, with their numbers of components.
    template <int dim, int spacedim>
    std::vector<std::pair<std::string, unsigned int>>
    fields(const Patches<dim, spacedim> &patches)
    {
      std::vector<std::pair<std::string, unsigned int>> result;
      for (unsigned int c = 0; c < patches.components.size(); ++c)
        {
          const auto vector =
            std::find_if(patches.vectors.begin(), patches.vectors.end(), [&](const auto &range) {
              return std::get<0>(range) <= c && c <= std::get<1>(range);
            });
          if (vector == patches.vectors.end())
            result.emplace_back(patches.components[c], 1);
          else
            {
              result.emplace_back(std::get<2>(*vector), 3);
              c = std::get<1>(*vector);
            }
        }
      return result;
    }


    /// The numbers of one field, or none if this rank has no patches.
    std::vector<double>
    field_data(const dealii::DataOutBase::DataOutFilter &filter, const std::string &name)
    {
      for (unsigned int set = 0; set < filter.n_data_sets(); ++set)
        if (filter.get_data_set_name(set) == name)
          {
            const double *data = filter.get_data_set(set);
            return std::vector<double>(
              data, data + std::size_t(filter.n_nodes()) * filter.get_data_set_dim(set));
          }
      return {};
    }
  } // namespace


  template <int dim, int spacedim>
  dealii::XDMFEntry
  write_hdf5(const MPI_Comm                communicator,
             const std::filesystem::path  &path,
             const std::string            &shown_as,
             const Patches<dim, spacedim> &patches,
             const double                  time)
  {
    const bool merge = patches.continuity == Patches<dim, spacedim>::Continuity::continuous;
    dealii::DataOutBase::DataOutFilter filter(
      dealii::DataOutBase::DataOutFilterFlags(/*filter_duplicate_vertices*/ merge,
                                              /*xdmf_hdf5_output*/ true));
    const bool has_patches = !patches.patches.empty(); // else the filter does not know its sizes
    if (has_patches)
      dealii::DataOutBase::write_filtered_data(
        patches.patches, patches.components, patches.vectors, filter);

    std::vector<double>       nodes;
    std::vector<unsigned int> cells;
    const Rows                node_rows(has_patches ? filter.n_nodes() : 0, communicator);
    const Rows                cell_rows(has_patches ? filter.n_cells() : 0, communicator);
    if (has_patches)
      {
        filter.fill_node_data(nodes);
        filter.fill_cell_data(node_rows.first, cells);
      }

    HDF5Writer file(path, communicator);
    file.add("nodes", node_rows.of_columns(spacedim), nodes);
    file.add("cells", cell_rows.of_columns(dealii::GeometryInfo<dim>::vertices_per_cell), cells);
    dealii::XDMFEntry entry(
      shown_as, shown_as, time, node_rows.total, cell_rows.total, dim, spacedim);
    for (const auto &[name, n_components] : fields(patches))
      {
        file.add(name, node_rows.of_columns(n_components), field_data(filter, name));
        entry.add_attribute(name, n_components);
      }
    file.commit();
    return entry;
  }


  template dealii::XDMFEntry
  write_hdf5(
    MPI_Comm, const std::filesystem::path &, const std::string &, const Patches<0, 2> &, double);
  template dealii::XDMFEntry
  write_hdf5(
    MPI_Comm, const std::filesystem::path &, const std::string &, const Patches<0, 3> &, double);
  template dealii::XDMFEntry
  write_hdf5(
    MPI_Comm, const std::filesystem::path &, const std::string &, const Patches<2> &, double);
  template dealii::XDMFEntry
  write_hdf5(
    MPI_Comm, const std::filesystem::path &, const std::string &, const Patches<3> &, double);
} // namespace undine
