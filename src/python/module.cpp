// SPDX-License-Identifier: BSD-3-Clause
// The extension module _meniscus: a run in progress for Python. src/python/meniscus/run.py is its
// face and has the documentation.
//
// The interpreter lock is released while C++ computes, so that runs in several threads compute at
// the same time. Arrays own their data: values at particles are computed when they are asked for,
// and a remap replaces the bodies of a run.
#include "meniscus/error.hpp"
#include "meniscus/run.hpp"

#include <fmt/core.h>
#include <omp.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <optional>
#include <utility>

namespace py = pybind11;

namespace {

using Overrides = std::vector<std::string>;

/// Sets the number of threads of parallel loops that this thread starts. 0 leaves it unchanged.
class Threads {
 public:
  explicit Threads(int number) : before_(omp_get_max_threads()) {
    if (number > 0) omp_set_num_threads(number);
  }
  ~Threads() { omp_set_num_threads(before_); }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

 private:
  int before_;
};

/// A run with what Python needs besides: the use by one thread at a time, and signals.
class Session {
 public:
  Session(const std::string& scene, bool is_text, const Overrides& overrides, int threads)
      : threads_(threads), run_(built(scene, is_text, overrides, threads)) {
    run_.stop_when([this] { return must_stop(); });
  }

  /// Returns work(run), called without the interpreter lock. Throws a Python exception if a signal
  /// has stopped the run, and std::runtime_error if the run is in use.
  template <class F>
  auto use(F&& work) {
    const InUse in_use(busy_);
    const Threads threads(threads_);
    try {
      const py::gil_scoped_release released;
      return work(run_);
    } catch (const meniscus::Interrupted&) {
      const py::error_already_set error = std::exchange(stop_, std::nullopt).value();
      throw error;
    }
  }

  void add_force(const std::string& body, const py::function& function) {
    use([&, function = kept(function)](meniscus::Run& run) {
      const int dimension = run.dimension();
      run.add_force(
          body, [this, function, dimension](double time, std::span<const double> x,
                                            std::span<const double> v, std::span<double> force) {
            compute(*function, time, x, v, dimension, force);
          });
    });
  }

 private:
  struct InUse {
    explicit InUse(std::atomic<bool>& busy) : busy_(busy) {
      if (busy.exchange(true))
        throw std::runtime_error(
            "the run is computing, in another thread or in the step that called this function; "
            "use it between steps");
    }
    ~InUse() { busy_ = false; }
    InUse(const InUse&) = delete;
    InUse& operator=(const InUse&) = delete;

   private:
    std::atomic<bool>& busy_;
  };

  static meniscus::Run built(const std::string& scene, bool is_text, const Overrides& overrides,
                             int number) {
    const Threads threads(number);
    const py::gil_scoped_release released;
    return is_text ? meniscus::Run::from_text(scene, overrides)
                   : meniscus::Run::from_file(scene, overrides);
  }

  /// A function that threads without the interpreter lock may copy and destroy.
  static std::shared_ptr<const py::function> kept(const py::function& function) {
    return {new py::function(function), [](const py::function* own) {
              const py::gil_scoped_acquire locked;
              delete own;
            }};
  }

  /// True if a signal has raised a Python exception, which is kept. Looks every 50 ms only, since
  /// each look waits for the interpreter lock.
  bool must_stop() {
    if (stop_) return true;
    constexpr std::chrono::milliseconds between{50};
    const auto now = std::chrono::steady_clock::now();
    if (now < next_look_) return false;
    next_look_ = now + between;
    const py::gil_scoped_acquire locked;
    if (PyErr_CheckSignals() == 0) return false;
    stop_.emplace();
    return true;
  }

  /// Calls the function of a force. Ctrl-C during the call stops the run at the end of the step.
  py::object call(const py::function& function, double time, const py::array& x,
                  const py::array& v) {
    try {
      return function(time, x, v);
    } catch (const py::error_already_set& error) {
      if (stop_ || !error.matches(PyExc_KeyboardInterrupt)) throw;
      stop_ = error;
    }
    return function(time, x, v);
  }

  void compute(const py::function& function, double time, std::span<const double> x,
               std::span<const double> v, int dimension, std::span<double> force) {
    const py::gil_scoped_acquire locked;
    const auto particles = static_cast<py::ssize_t>(x.size()) / dimension;
    const std::vector<py::ssize_t> shape{particles, dimension};
    const py::object result = call(function, time, py::array_t<double>(shape, x.data()),
                                   py::array_t<double>(shape, v.data()));
    const auto values =
        py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(result);
    if (!values) PyErr_Clear();
    if (!values || values.ndim() != 2 || values.shape(0) != particles ||
        values.shape(1) != dimension)
      throw meniscus::SolveError(
          fmt::format("the function has returned {}; expected is an array of shape ({}, {})",
                      described(result), particles, dimension));
    std::copy_n(values.data(), force.size(), force.begin());
  }

  static std::string described(const py::object& result) {
    if (py::hasattr(result, "shape"))
      return "an array of shape " + py::str(result.attr("shape")).cast<std::string>();
    return "an object of type " +
           py::str(py::type::of(result).attr("__name__")).cast<std::string>();
  }

  int threads_;
  meniscus::Run run_;
  std::atomic<bool> busy_ = false;
  std::optional<py::error_already_set> stop_;  // the exception that is raised between steps
  std::chrono::steady_clock::time_point next_look_;
};

/// An array that owns the values: [particle] or [particle, component].
py::array array_of(meniscus::Field field) {
  auto* const values = new std::vector<double>(std::move(field.values));
  const py::capsule owner(values, [](void* own) { delete static_cast<std::vector<double>*>(own); });
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(values->size()) / field.components};
  if (field.components > 1) shape.push_back(field.components);
  return py::array_t<double>(shape, values->data(), owner);
}

/// Raises the exception of meniscus/errors.py.
void raise(const char* name, const std::exception& error) {
  PyErr_SetString(py::module_::import("meniscus.errors").attr(name).ptr(), error.what());
}

void translate(std::exception_ptr thrown) {
  try {
    std::rethrow_exception(std::move(thrown));
  } catch (const meniscus::InputError& error) {
    raise("InputError", error);
  } catch (const meniscus::SolveError& error) {
    raise("SolveError", error);
  } catch (const meniscus::FileError& error) {
    raise("FileError", error);
  }
}

/// A function of Python that calls a function of a run with these arguments.
template <class Result, class... Arguments>
auto method(Result (meniscus::Run::*function)(Arguments...)) {
  return [function](Session& session, std::decay_t<Arguments>... arguments) {
    return session.use([&](meniscus::Run& run) { return (run.*function)(arguments...); });
  };
}
template <class Result, class... Arguments>
auto method(Result (meniscus::Run::*function)(Arguments...) const) {
  return [function](Session& session, std::decay_t<Arguments>... arguments) {
    return session.use([&](meniscus::Run& run) { return (run.*function)(arguments...); });
  };
}

}  // namespace

PYBIND11_MODULE(_meniscus, module) {
  using meniscus::Run;
  py::register_local_exception_translator(translate);
  py::class_<meniscus::SavedState>(module, "Snapshot", "The whole state of a run, in memory.")
      .def_property_readonly("hash", &meniscus::SavedState::hash,
                             "A number of 64 bits, equal for equal states.");
  const auto field = [](Session& session, const std::string& body, const std::string& name) {
    return session.use([&](Run& run) { return run.field(body, name); });
  };
  py::class_<Session>(module, "Run", "A run in progress; meniscus.Run documents its functions.")
      .def(py::init<const std::string&, bool, const Overrides&, int>(), py::arg("scene"),
           py::arg("is_text"), py::arg("overrides"), py::arg("threads"))
      .def("dimension", method(&Run::dimension))
      .def("time", method(&Run::time))
      .def("steps", method(&Run::step))
      .def("finished", method(&Run::finished))
      .def("step", method(&Run::advance))
      .def("advance_to", method(&Run::advance_to), py::arg("time"))
      .def("bodies", method(&Run::bodies))
      .def("measures", method(&Run::measures))
      .def("fields", method(&Run::fields), py::arg("body"))
      .def("measure", method(&Run::measure), py::arg("name"))
      .def("unit", method(&Run::unit), py::arg("measure"))
      .def("energies", method(&Run::energies))
      .def(
          "field",
          [field](Session& session, const std::string& body, const std::string& name) {
            return array_of(field(session, body, name));
          },
          py::arg("body"), py::arg("name"))
      .def(
          "field_unit",
          [field](Session& session, const std::string& body, const std::string& name) {
            return field(session, body, name).unit;
          },
          py::arg("body"), py::arg("name"))
      .def("add_force", &Session::add_force, py::arg("body"), py::arg("function"))
      .def("snapshot", method(&Run::snapshot))
      .def("restore", method(py::overload_cast<const meniscus::SavedState&>(&Run::restore)),
           py::arg("snapshot"))
      .def("save", method(&Run::save), py::arg("directory"))
      .def("load", method(py::overload_cast<const std::string&>(&Run::restore)),
           py::arg("directory"));
}
