// SPDX-License-Identifier: BSD-3-Clause
// Prints an exception and returns the exit code that belongs to it.
#include "app/commands.hpp"
#include "app/print.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <exception>
#include <new>

namespace meniscus {
namespace {

int complain(const char* kind, const std::exception& e, int code) {
  print_complaint(fmt::format("{}{}", kind, e.what()));
  return code;
}

}  // namespace

int exit_code_of(const std::function<int()>& command) {
  secure_streams();
  try {
    return command();
  } catch (const InputError& e) {
    return complain("", e, exit_input);
  } catch (const SolveError& e) {
    return complain("the run failed: ", e, exit_numerical);
  } catch (const FileError& e) {
    return complain("", e, exit_file);
  } catch (const std::bad_alloc& e) {
    return complain("not enough memory: ", e, exit_numerical);
  } catch (const std::exception& e) {
    return complain("internal error: ", e, exit_internal);
  }
}

}  // namespace meniscus
