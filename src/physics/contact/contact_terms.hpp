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

/// How forces follow from the interaction of the points (CGCM notes 2 and 4). With G = b1 b2
/// contained in the weights V (area vectors) and r = x1 - x2, the force on point 1 is:
enum class ContactForm {
  energy,       ///< the gradient of sum u(r) V1.V2: conserves energy and momenta exactly
  pressure,     ///< - V1 (r.V2) psi: disjoining pressure; conservative where the gap is resolved
  volume,       ///< - phi'(r) r/|r| of volume points: conserves exactly, needs very fine points
  dissertation  ///< - V2 (r.V1) psi, (3.30) of Fan 2014: not the gradient of any energy
};
inline constexpr std::array<std::string_view, 4> contact_form_names{"energy", "pressure", "volume",
                                                                    "dissertation"};

struct ContactChoice {
  std::string name;  ///< name of the pair in messages and measures
  ContactForm form = ContactForm::energy;
  SiteDensity density = SiteDensity::constant;
  /// [body] True if its contact points lie on patches (ContactPoints::on_patches). They should, if
  /// the surface tension of the body acts on the same patches.
  std::array<bool, 2> on_patches{false, false};
  int points = 2;     ///< Gauss points per direction of a facet, or of a cell
  Real skin = 0.4;    ///< of the list, / sigma0 (of a law of the gap: / quarter of its range)
  Real friction = 0;  ///< with a rigid partner: traction / speed along it where they touch
  /// For laws of the gap between two bodies: the direction from the second body to the first if the
  /// second is the ground on which the first rests. If empty, both bodies are treated alike.
  std::vector<Real> up = {};
  std::string fold = {};     ///< consequence of a ground that folds over, for messages
  std::string overlap = {};  ///< reason why surfaces may pass through each other, for messages
  bool wets = false;         ///< the body has a surface tension: measures of wetting are useful
};

/// Points on the surface of the first (`side` 0) or second (1) body of a contact, with `beta`
/// interaction sites per area.
template <int D>
ContactPoints<D> surface_contact_points(const Body<D>& body, Real beta, const ContactChoice& choice,
                                        std::size_t side,
                                        Clusters clusters = Clusters::of_neighbours) {
  if (choice.on_patches[side] && choice.density == SiteDensity::constant)
    return ContactPoints<D>::on_patches(body, beta, choice.points, clusters);
  return ContactPoints<D>::on_surface(body, beta, choice.density, choice.points, clusters);
}

/// The contact points of a body for each grade, the finest first. With several grades, the points
/// of a facet form clusters of their own.
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

/// A body with `beta` interaction sites per volume.
template <int D>
struct ContactBody {
  const Body<D>& body;
  Real beta;
};

/// Contact of two bodies by pair sums; the law has a cut-off. A step to a gap below the guard of
/// the law is a failure that a shorter step may avoid.
template <int D>
std::unique_ptr<ForceTerm> contact_pair(const ContactBody<D>& first, const ContactBody<D>& second,
                                        const ContactLaw& law, const ContactChoice& choice);

/// Contact of two bodies by a law of the gap between their surfaces. The law is brought to zero
/// over the last quarter of its range (CGCM note 11). Throws InputError for any form but `energy`.
/// With a pattern, the energy supplied by changes of W with time is external work.
///
/// If the second body is ground, the energy is summed over the points of the first body only, as
/// above a rigid partner. The gap is measured along `up`. The pattern may then depend on the
/// position in the reference of the ground.
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
  Real velocity_step = 0;  ///< step of the difference quotient for its velocity: 1e-4 of the run
  std::shared_ptr<const PartnerShape<D>> surface = nullptr;  ///< friction needs it
};

/// Contact of a body with a rigid partner, by the field of the interaction. Throws InputError for
/// the form `volume`. An interaction with a pattern needs the form `energy`. The energy is then the
/// sum of W S.V over the points, where x in W(x, t) is a position in the frame of the partner; the
/// energy supplied by changes of W with time is external work.
///
/// Friction is the traction -friction chi v_t on the area that faces the partner. v_t is the
/// tangential velocity relative to the partner. chi is 1 where the surface rests, and decreases
/// with the energy of the interaction.
template <int D>
std::unique_ptr<ForceTerm> rigid_contact(const ContactBody<D>& body, MovingPartner<D> partner,
                                         std::shared_ptr<const Interaction> interaction,
                                         const ContactChoice& choice);
/// Like the function above, for a partner whose field follows from `law`.
template <int D>
std::unique_ptr<ForceTerm> rigid_contact(const ContactBody<D>& body, MovingPartner<D> partner,
                                         const ContactLaw& law, const ContactChoice& choice);

}  // namespace meniscus
