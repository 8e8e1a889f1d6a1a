// SPDX-License-Identifier: BSD-3-Clause
// Adhesive contact of two bodies, or of a body with a rigid partner (CGCM note).
#pragma once
#include "physics/contact/contact_law.hpp"
#include "physics/contact/gap/interaction.hpp"
#include "physics/contact/points/contact_points.hpp"
#include "physics/contact/points/facet_grades.hpp"
#include "physics/contact/rigid/rigid_motion.hpp"
#include "physics/contact/rigid/rigid_partner.hpp"

#include <array>
#include <memory>
#include <string_view>

namespace meniscus {

/// How the forces follow from the interaction of the points (CGCM notes 2 and 4). With G = b1 b2 in
/// the weights V (area vectors) and r = x1 - x2, the force on point 1 is:
enum class ContactForm {
  energy,       ///< the gradient of sum u(r) V1.V2: conserves energy and momenta exactly
  pressure,     ///< - V1 (r.V2) psi: disjoining pressure; conservative where the gap is resolved
  volume,       ///< - phi'(r) r/|r| of volume points: conserves exactly, needs very fine points
  dissertation  ///< - V2 (r.V1) psi, (3.30) of Fan 2014: not the gradient of any energy
};
inline constexpr std::array<std::string_view, 4> contact_form_names{"energy", "pressure", "volume",
                                                                    "dissertation"};

struct ContactChoice {
  std::string name;  ///< of the pair, in messages and measures
  ContactForm form = ContactForm::energy;
  SiteDensity density = SiteDensity::constant;
  /// [body] whether its points are those of patches (ContactPoints::on_patches), as they should be
  /// where the tension of its surface is that of the same patches.
  std::array<bool, 2> on_patches{false, false};
  int points = 2;     ///< Gauss points per direction of a facet, or of a cell
  Real skin = 0.4;    ///< of the list, / sigma0 (of a law of the gap: / quarter of its range)
  Real friction = 0;  ///< with a rigid partner: traction / speed along it where they touch
  /// Of a law of the gap between two bodies: from the second to the first, if the second is ground
  /// on which the first rests; empty: both are treated alike.
  std::vector<Real> up = {};
  std::string fold = {};     ///< what it means if the ground folds over, for messages
  std::string overlap = {};  ///< why surfaces may come through it during a run, for messages
  bool wets = false;  ///< the body has a surface tension: measures of wetting are of interest
};

/// Points of the surface of a body, the first (0) or second (1) of a contact, with `beta` per area.
template <int D>
ContactPoints<D> surface_contact_points(const Body<D>& body, Real beta, const ContactChoice& choice,
                                        std::size_t side,
                                        Clusters clusters = Clusters::of_neighbours) {
  if (choice.on_patches[side] && choice.density == SiteDensity::constant)
    return ContactPoints<D>::on_patches(body, beta, choice.points, clusters);
  return ContactPoints<D>::on_surface(body, beta, choice.density, choice.points, clusters);
}

/// Its points by grade, the finest first. With several, those of a facet are clusters of their own.
template <int D>
std::vector<ContactPoints<D>> graded_contact_points(const Body<D>& body, Real beta,
                                                    const ContactChoice& choice, std::size_t side,
                                                    const FacetGrades& grades) {
  std::vector<ContactPoints<D>> all;
  ContactChoice of_grade = choice;
  const Clusters clusters = grades.count() > 1 ? Clusters::of_facets : Clusters::of_neighbours;
  for (const int points : grades.points()) {
    of_grade.points = points;
    all.push_back(surface_contact_points(body, beta, of_grade, side, clusters));
  }
  return all;
}

/// A body with `beta` particles of the interaction per volume.
template <int D>
struct ContactBody {
  const Body<D>& body;
  Real beta;
};

/// Contact of two bodies; the law has a cut-off. Steps into a gap below the guard of the law are
/// failures that a shorter step may avoid.
template <int D>
std::unique_ptr<ForceTerm> contact_pair(const ContactBody<D>& first, const ContactBody<D>& second,
                                        const ContactLaw& law, const ContactChoice& choice);

/// Contact of two bodies by a law of the gap between their surfaces, brought to zero over the last
/// quarter of its range (CGCM note 11). Throws InputError for another form than `energy`. With a
/// pattern, what a change of W with time supplies is external work. On ground the energy is that of
/// the points of the first alone, as above a rigid partner, of the gap along `up`, and the pattern
/// may be one of the place in the reference of the ground.
template <int D>
std::unique_ptr<ForceTerm> gap_pair(const Body<D>& first, const Body<D>& second,
                                    std::shared_ptr<const Interaction> law,
                                    const ContactChoice& choice);

template <int D>
class PartnerShape;

/// A rigid partner in motion.
template <int D>
struct MovingPartner {
  std::unique_ptr<RigidPartner<D>> shape;
  RigidMotion<D> motion = {};
  Real beta = 1;
  Real velocity_step = 0;  ///< of the difference that gives its velocity: 1e-4 of the run
  std::shared_ptr<const PartnerShape<D>> surface = nullptr;  ///< friction needs it
};

/// Contact of a body with a rigid partner, whose field is that of the interaction; any form but
/// `volume`, for which InputError is thrown. An interaction with a pattern needs the form `energy`;
/// the energy is then the sum of W S.V over the points, x of W(x, t) in the frame of the partner,
/// and what a change of W with time supplies is external work. Friction is the traction
/// -friction chi v_t, v_t the velocity along the partner relative to it, on the area that faces it;
/// chi is 1 where the surface rests, and falls with the energy of the interaction.
template <int D>
std::unique_ptr<ForceTerm> rigid_contact(const ContactBody<D>& body, MovingPartner<D> partner,
                                         std::shared_ptr<const Interaction> interaction,
                                         const ContactChoice& choice);
/// The same for a partner made with `law`.
template <int D>
std::unique_ptr<ForceTerm> rigid_contact(const ContactBody<D>& body, MovingPartner<D> partner,
                                         const ContactLaw& law, const ContactChoice& choice);

}  // namespace meniscus
