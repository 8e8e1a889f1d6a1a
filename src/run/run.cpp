// SPDX-License-Identifier: BSD-3-Clause
// A scene run from another program.
#include "meniscus/run.hpp"

#include "body/particle_values.hpp"
#include "input/names.hpp"
#include "io/checkpoint.hpp"
#include "meniscus/error.hpp"
#include "run/epochs.hpp"
#include "run/particle_force.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

namespace meniscus {

struct Run::Base {
  virtual ~Base() = default;
  virtual int dimension() const = 0;
  virtual double time() const = 0;
  virtual std::int64_t step() const = 0;
  virtual bool finished() const = 0;
  virtual void advance() = 0;
  virtual void stop_when(std::function<bool()> asked) = 0;
  virtual void add_force(const std::string& body, ForceFunction force) = 0;
  virtual std::vector<std::string> bodies() const = 0;
  virtual std::vector<std::string> measures() const = 0;
  virtual std::vector<std::string> fields(const std::string& body) const = 0;
  virtual double measure(const std::string& name) const = 0;
  virtual std::string unit(const std::string& measure) const = 0;
  virtual Field field(const std::string& body, const std::string& name) const = 0;
  virtual std::map<std::string, double> energies() const = 0;
  virtual Snapshot snapshot() = 0;
  virtual void restore(const Snapshot& state) = 0;
  virtual void save(const std::string& directory) = 0;
};

namespace {

/// Position of a name in `names`. Throws InputError that lists them.
std::size_t find(const char* what, const std::string& name, const std::vector<std::string>& names) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw InputError(
        fmt::format("there is no {} '{}'; {}", what, name, allowed_names(name, names)));
  return static_cast<std::size_t>(found - names.begin());
}

template <class Sources>
std::vector<std::string> names_of(const Sources& sources) {
  std::vector<std::string> names;
  for (const auto& source : sources) names.push_back(source.name);
  return names;
}

template <int D>
class RunIn final : public Run::Base {
 public:
  explicit RunIn(const SceneInput& input) : epochs_(read_plan<D>(input)) {
    epochs_.simulation().begin();
    epochs_.simulation().settle();
  }

  int dimension() const override { return D; }
  double time() const override { return now().time; }
  std::int64_t step() const override { return now().step; }
  bool finished() const override { return epochs_.simulation().finished(); }
  void advance() override {
    if (failed_)
      throw SolveError(fmt::format(
          "the run cannot go on after its failure at step {}; restore a state or begin a new run",
          step() + 1));
    if (asked_ && asked_()) throw Interrupted();
    failed_ = true;
    try {
      if (epochs_.advance().new_epoch) epochs_.simulation().stop_when(asked_);
    } catch (const Interrupted&) {
      failed_ = false;
      throw;
    }
    failed_ = false;
  }
  void stop_when(std::function<bool()> asked) override {
    asked_ = std::move(asked);
    epochs_.simulation().stop_when(asked_);
  }
  void add_force(const std::string& body, ForceFunction force) override {
    find("body", body, bodies());
    epochs_.add(particle_force<D>(body, std::move(force)));
    epochs_.simulation().stop_when(asked_);
  }

  std::vector<std::string> bodies() const override { return names_of(scene().system.bodies); }
  std::vector<std::string> measures() const override { return names_of(scene().measures); }
  std::vector<std::string> fields(const std::string& body) const override {
    std::vector<std::string> names{"position", "displacement", "velocity", "mass"};
    const std::size_t b = find("body", body, bodies());
    for (const BodyField& field : scene().fields)
      if (field.body == b &&
          std::find(names.begin(), names.end(), field.source.name) == names.end())
        names.push_back(field.source.name);
    return names;
  }

  double measure(const std::string& name) const override {
    return scene().measures[find("measure", name, measures())].compute(now().motion());
  }

  std::string unit(const std::string& name) const override {
    return scene().units.symbol(scene().measures[find("measure", name, measures())].dimension);
  }

  Field field(const std::string& body_name, const std::string& name) const override {
    const std::size_t b = find("body", body_name, bodies());
    const std::size_t k = find("field", name, fields(body_name));
    const Body<D>& body = scene().system.bodies[b];
    const State& state = now();
    const auto unit = [&](Dimension d) { return scene().units.symbol(d); };
    switch (k) {
      case 0:
        return {D, unit(dimension::length), places(body, state.u, true)};
      case 1:
        return {D, unit(dimension::length), places(body, state.u, false)};
      case 2:
        return {D, unit(dimension::velocity), places(body, state.v, false)};
      case 3:
        return {1, scene().symbol_of_sum(dimension::mass), body.mass};
      default:
        break;
    }
    const FieldSource& source = field_named(scene(), name);
    const std::vector<Real> all = field_values(scene(), name, state.motion());
    const auto begin = all.begin() + body.first * source.components;
    return {source.components,
            unit(source.dimension),
            {begin, begin + body.size() * source.components}};
  }

  void save(const std::string& directory) override {
    const RunDirectory folder(directory, ExistingRun::keep);
    CheckpointWriter(folder, provenance("a program with the library", scene().complete))
        .write(step(), time(), snapshot());
  }
  Snapshot snapshot() override { return epochs_.simulation().snapshot(); }
  void restore(const Snapshot& state) override {
    failed_ = true;
    epochs_.restore(state);
    epochs_.simulation().stop_when(asked_);
    failed_ = false;
  }

  std::map<std::string, double> energies() const override {
    const Ledger ledger = take_ledger(scene().system, now());
    std::map<std::string, double> all = ledger.stored;
    all["kinetic"] = ledger.kinetic;
    all["dissipated"] = ledger.dissipated;
    all["external_work"] = ledger.external_work;
    all["remapped"] = ledger.remapped;
    return all;
  }

 private:
  /// Values at the particles, sum_B N_B(X_A) f_B, plus X_A for positions.
  static std::vector<double> places(const Body<D>& body, const NodalVectors& f, bool position) {
    const NodalVectors x = values_at_particles(body, f.data() + body.first);
    std::vector<double> values;
    for (Index A = 0; A < body.size(); ++A)
      for (int i = 0; i < D; ++i)
        values.push_back(at(x, A)[i] + (position ? at(body.particles.X(), A)[i] : 0.0));
    return values;
  }

  const Scene<D>& scene() const { return epochs_.scene(); }
  const State& now() const { return epochs_.simulation().state(); }

  Epochs<D> epochs_;
  std::function<bool()> asked_;
  bool failed_ = false;  // a step or restore() has left an incomplete state
};

std::unique_ptr<Run::Base> begin(const SceneInput& input) {
  if (scene_dimension(input) == 2) return std::make_unique<RunIn<2>>(input);
  return std::make_unique<RunIn<3>>(input);
}

}  // namespace

std::uint64_t SavedState::hash() const {
  return snapshot_->hash();
}

Run::Run(std::unique_ptr<Base> base) : base_(std::move(base)) {}
Run::Run(Run&&) noexcept = default;
Run& Run::operator=(Run&&) noexcept = default;
Run::~Run() = default;

Run Run::from_file(const std::string& path, const std::vector<std::string>& overrides) {
  return Run(begin(SceneInput::from_file(path, overrides)));
}
Run Run::from_text(const std::string& toml, const std::vector<std::string>& overrides) {
  return Run(begin(SceneInput::from_text(toml, "scene", overrides)));
}

int Run::dimension() const {
  return base_->dimension();
}
double Run::time() const {
  return base_->time();
}
std::int64_t Run::step() const {
  return base_->step();
}
bool Run::finished() const {
  return base_->finished();
}
void Run::advance() {
  base_->advance();
}
void Run::advance_to(double time) {
  constexpr double of_rounding = 1e-9;  // eight steps of 0.1 s come to 0.7999999999999999 s
  while (!finished() && this->time() < time * (1 - of_rounding)) advance();
}
void Run::stop_when(std::function<bool()> asked) {
  base_->stop_when(std::move(asked));
}
void Run::add_force(const std::string& body, ForceFunction force) {
  base_->add_force(body, std::move(force));
}
std::vector<std::string> Run::bodies() const {
  return base_->bodies();
}
std::vector<std::string> Run::measures() const {
  return base_->measures();
}
std::vector<std::string> Run::fields(const std::string& body) const {
  return base_->fields(body);
}
double Run::measure(const std::string& name) const {
  return base_->measure(name);
}
std::string Run::unit(const std::string& measure) const {
  return base_->unit(measure);
}
Field Run::field(const std::string& body, const std::string& name) const {
  return base_->field(body, name);
}
std::map<std::string, double> Run::energies() const {
  return base_->energies();
}
SavedState Run::snapshot() {
  return SavedState(std::make_shared<const Snapshot>(base_->snapshot()));
}
void Run::restore(const SavedState& state) {
  base_->restore(state.snapshot());
}
void Run::save(const std::string& directory) {
  base_->save(directory);
}
void Run::restore(const std::string& directory) {
  base_->restore(read_checkpoint(directory).checkpoint.state);
}

}  // namespace meniscus
