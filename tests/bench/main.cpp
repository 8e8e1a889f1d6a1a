// SPDX-License-Identifier: BSD-3-Clause
// Runs the measurements and prints a table per group.
#include "measure.hpp"

#include <fmt/core.h>

namespace meniscus::bench {
namespace {

/// One line per case; a new header when the group or its columns change.
class Table final : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }

  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      const std::string full = run.run_name.function_name;
      const auto slash = full.find('/');
      const std::string group = full.substr(0, slash), name = full.substr(slash + 1);
      if (run.error_occurred) {
        fmt::print("{:<44} {}\n", name, run.error_message);
        continue;
      }
      if (group != group_) print_head(group, run);
      fmt::print("{:<44}", name);
      for (const auto& [column, counter] : run.counters)
        fmt::print(" {:>{}.4g}", counter.value, width(column));
      fmt::print("\n");
      std::fflush(stdout);
    }
  }

 private:
  static constexpr std::size_t order_digits = 2;  // see set_columns()
  static std::size_t width(const std::string& column) {
    return std::max<std::size_t>(8, column.size() - order_digits);
  }

  void print_head(const std::string& group, const Run& run) {
    fmt::print("{}{:<44}", group_.empty() ? "" : "\n", group);
    for (const auto& [column, counter] : run.counters)
      fmt::print(" {:>{}}", column.substr(order_digits), width(column));
    fmt::print("\n");
    group_ = group;
  }

  std::string group_;
};

}  // namespace
}  // namespace meniscus::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  meniscus::bench::add_material_cases();
  meniscus::bench::add_shape_function_cases();
  meniscus::bench::add_force_cases();
  meniscus::bench::add_contact_cases();
  meniscus::bench::add_memory_cases();
  meniscus::bench::Table table;
  benchmark::RunSpecifiedBenchmarks(&table);
}
