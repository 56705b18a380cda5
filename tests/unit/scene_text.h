// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_scene_text_h
#define undine_tests_scene_text_h

#include <undine/base/options/options.h>
#include <undine/base/options/parameter_file.h>

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

namespace undine_tests
{
  /// The options that a text gives.
  inline undine::Options
  read_scene_text(const std::string &text)
  {
    const auto name =
      std::filesystem::temp_directory_path() / fmt::format("undine_scene_{}.prm", getpid());
    std::ofstream(name) << text;
    const undine::ParameterFile file(name.string());
    std::filesystem::remove(name);
    return undine::Options(file);
  }
} // namespace undine_tests

#endif
