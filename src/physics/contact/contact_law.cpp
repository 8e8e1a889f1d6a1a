// SPDX-License-Identifier: BSD-3-Clause
// Names of the kernels, and all pair functions at one distance.
#include "physics/contact/contact_law.hpp"

#include "input/names.hpp"
#include "meniscus/error.hpp"

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace meniscus {
namespace {

constexpr std::array<std::pair<PairKernel, std::string_view>, 3> kernel_names{
    {{PairKernel::space, "space"},
     {PairKernel::integrated, "integrated"},
     {PairKernel::planar, "planar"}}};

/// Value and three derivatives of a function of r.
template <class T>
using RadialFunction = std::array<T, 4>;

/// Adds c r^power with its derivatives.
template <class T>
void add_power(RadialFunction<T>& f, Real c, int power, T r) {
  T term = c * std::pow(r, power);
  for (int k = 0; k < 4; ++k) {
    at(f, k) += term;
    term *= static_cast<Real>(power - k) / r;
  }
}

/// u without cut-off.
template <class T>
RadialFunction<T> bare_energy(const ContactLaw& law, T r) {
  const PairCoefficients c = pair_coefficients(law.kernel);
  RadialFunction<T> u{};
  add_power(u, law.epsilon * c.u12 * std::pow(law.sigma0, 12), c.odd - 10, r);
  add_power(u, law.epsilon * c.u6 * std::pow(law.sigma0, 6), c.odd - 4, r);
  return u;
}

/// Q = 1 - 10 t^3 + 15 t^4 - 6 t^5 between the begin of the switch and the cut-off.
template <class T>
RadialFunction<T> switch_off(const ContactLaw& law, T r) {
  const Real begin = switch_begin * law.reach(), width = law.reach() - begin;
  if (std::real(r) <= begin) return {T(1), T(0), T(0), T(0)};
  if (std::real(r) >= law.reach()) return {T(0), T(0), T(0), T(0)};
  const T t = (r - begin) / width;
  RadialFunction<T> Q{T(1), T(0), T(0), T(0)};
  add_power(Q, -10, 3, t);
  add_power(Q, 15, 4, t);
  add_power(Q, -6, 5, t);
  for (int k = 1; k < 4; ++k) at(Q, k) /= std::pow(width, k);
  return Q;
}

}  // namespace

std::string_view name_of(PairKernel kernel) {
  return at(kernel_names, static_cast<int>(kernel)).second;
}

PairKernel pair_kernel_named(std::string_view name) {
  std::vector<std::string> known;
  for (const auto& [kernel, text] : kernel_names) {
    if (text == name) return kernel;
    known.emplace_back(text);
  }
  throw InputError("there is no contact kernel '" + std::string(name) + "'; " +
                   allowed_names(name, known));
}

template <class T>
PairFunctions<T> pair_functions(const ContactLaw& law, T r) {
  RadialFunction<T> u = bare_energy(law, r);
  if (law.cut()) {
    const RadialFunction<T> b = u, Q = switch_off(law, r);
    u = {b[0] * Q[0], b[1] * Q[0] + b[0] * Q[1], b[2] * Q[0] + 2.0 * b[1] * Q[1] + b[0] * Q[2],
         b[3] * Q[0] + 3.0 * (b[2] * Q[1] + b[1] * Q[2]) + b[0] * Q[3]};
  }
  const Real side = dimension_of(law.kernel) - 1;
  PairFunctions<T> f;
  f.u = u[0];
  f.du = u[1];
  f.ddu = u[2];
  f.psi = u[1] / r;
  f.dpsi = (u[2] - f.psi) / r;
  f.phi = -(u[2] + side * f.psi);
  f.dphi = -(u[3] + side * f.dpsi);
  f.chi = -(r * u[1] + (side - 1) * u[0]);
  return f;
}
template PairFunctions<Real> pair_functions(const ContactLaw&, Real);
template PairFunctions<Complex> pair_functions(const ContactLaw&, Complex);

}  // namespace meniscus
