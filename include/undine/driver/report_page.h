// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_driver_report_page_h
#define undine_driver_report_page_h

#include <undine/driver/log.h>
#include <undine/output/files/result_folder.h>

#include <deal.II/base/mpi.h>

#include <chrono>

namespace undine
{
  /// The page `report.html` in the folder of a run, made of the files there by the Python package
  /// `report` beside the sources. It is a service: where it cannot be written the user is told,
  /// and it is not tried again but at the end; the run goes on. With the environment variable
  /// `UNDINE_REPORT=off` there is none, with `always` one at every output.
  class ReportPage
  {
  public:
    /// `wanted`: by the scene. The references must outlive it. Collective.
    ReportPage(ResultFolder &folder, bool wanted, Log &log, MPI_Comm communicator);

    /// Shall it be written anew while the run goes on? That takes at most 2 % of the wall time.
    /// Collective.
    bool
    due() const;

    /// Collective. Throws no FileError.
    void
    write();

    /// The last time. Collective. Throws no FileError.
    void
    finish();

  private:
    using Clockwork = std::chrono::steady_clock;

    /// Why it cannot be written; empty if it was. Collective.
    std::string
    try_to_write();

    ResultFolder         &folder;
    Log                  &log;
    MPI_Comm              communicator;
    bool                  is_on;
    bool                  has_failed = false;
    Clockwork::time_point last       = Clockwork::now();
    Clockwork::duration   of_page = std::chrono::seconds(1); ///< what writing took, first a guess
  };
} // namespace undine

#endif
