// SPDX-License-Identifier: BSD-3-Clause
// The log of a run. This is the only file that includes spdlog.
#include "io/run_log.hpp"

#include "input/text.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>
#include <spdlog/logger.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>

#include <algorithm>

namespace meniscus {
namespace {

spdlog::sink_ptr stderr_sink() {
  auto sink = std::make_shared<spdlog::sinks::stderr_sink_mt>();
  sink->set_level(spdlog::level::warn);
  sink->set_pattern("%l: %v");
  return sink;
}

spdlog::sink_ptr file_sink(const std::filesystem::path& file) {
  try {
    auto sink = std::make_shared<spdlog::sinks::basic_file_sink_mt>(file.string());
    sink->set_formatter(std::make_unique<spdlog::pattern_formatter>(
        "%Y-%m-%dT%H:%M:%SZ %l: %v", spdlog::pattern_time_type::utc));
    return sink;
  } catch (const spdlog::spdlog_ex& failure) {
    throw FileError(fmt::format("cannot write '{}': {}", file.string(), failure.what()));
  }
}

}  // namespace

struct RunLog::Logger {
  explicit Logger(std::initializer_list<spdlog::sink_ptr> sinks) : log("meniscus", sinks) {
    log.flush_on(spdlog::level::info);
    // Failed writing is not reported for each line, because the run itself will fail.
    log.set_error_handler([](const std::string&) {});
  }
  spdlog::logger log;
  std::vector<std::pair<std::string, int>> warnings;
};

RunLog::RunLog() : logger_(new Logger{stderr_sink()}) {}
RunLog::RunLog(const std::filesystem::path& file)
    : logger_(new Logger{file_sink(file), stderr_sink()}) {}
RunLog::RunLog(std::unique_ptr<Logger> logger) : logger_(std::move(logger)) {}
RunLog RunLog::silent() {
  return RunLog(std::unique_ptr<Logger>(new Logger{}));
}
RunLog::~RunLog() = default;
RunLog::RunLog(RunLog&&) noexcept = default;
RunLog& RunLog::operator=(RunLog&&) noexcept = default;

void RunLog::info(std::string_view message) {
  logger_->log.info(readable(message));
}
void RunLog::warning(std::string_view message) {
  logger_->log.warn(readable(message));
  auto& all = logger_->warnings;
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const auto& known) { return known.first == message; });
  if (found == all.end())
    all.emplace_back(message, 1);
  else
    ++found->second;
}
void RunLog::error(std::string_view message) {
  logger_->log.error(readable(message));
}
const std::vector<std::pair<std::string, int>>& RunLog::warnings() const {
  return logger_->warnings;
}

}  // namespace meniscus
