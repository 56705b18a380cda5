// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/base/core/version.h>
#include <undine/driver/other_program.h>
#include <undine/driver/report_page.h>

#include <cstdlib>

namespace undine
{
  namespace
  {
    constexpr int pause = 50; // before a page is written anew, in times of what that takes

    constexpr std::chrono::seconds limit(120); // for a busy machine that searches its fonts first


    /// Is that what the environment asks for?
    bool
    user_wants(const std::string &answer)
    {
      const char *variable = std::getenv("UNDINE_REPORT");
      return variable != nullptr && variable == answer;
    }


    /// Where Python finds the package `report`: with the sources, unless what has started the
    /// program knows better, as where it is installed.
    std::string
    python_parts()
    {
      const char *variable = std::getenv("UNDINE_PYTHON_PARTS");
      return variable != nullptr ? variable : UNDINE_SOURCE_FOLDER;
    }
  } // namespace


  ReportPage::ReportPage(ResultFolder  &folder,
                         const bool     wanted,
                         Log           &log,
                         const MPI_Comm communicator)
    : folder(folder)
    , log(log)
    , communicator(communicator)
    , is_on(dealii::Utilities::MPI::broadcast(communicator, wanted && !user_wants("off")))
  {
  }


  bool
  ReportPage::due() const
  {
    const bool is_old = Clockwork::now() - last > pause * of_page || user_wants("always");
    return is_on && !has_failed && dealii::Utilities::MPI::broadcast(communicator, is_old);
  }


  std::string
  ReportPage::try_to_write()
  {
    try
      {
        folder.claim("report.html");
      }
    catch (const FileError &error)
      {
        return error.what();
      }
    std::string failure;
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      failure = call_program({"/usr/bin/python3", "-B", "-m", "report", folder.path().string()},
                             // Not a module of the user's in the current folder.
                             {"PYTHONPATH=" + python_parts(), "PYTHONSAFEPATH=1"},
                             limit);
    return dealii::Utilities::MPI::broadcast(communicator, failure);
  }


  void
  ReportPage::write()
  {
    if (!is_on)
      return;
    const auto begin   = Clockwork::now();
    const auto failure = try_to_write();
    last               = Clockwork::now();
    of_page            = last - begin;
    has_failed         = !failure.empty();
    if (has_failed)
      log.print("note: 'report.html' is not written: {}", failure);
  }


  void
  ReportPage::finish()
  {
    write();
    if (is_on && !has_failed)
      log.print("\nreport: {}", (folder.path() / "report.html").string());
  }
} // namespace undine
