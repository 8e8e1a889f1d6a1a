// SPDX-License-Identifier: BSD-3-Clause
// Rigid bodies with straight edges in plane strain (polygons and frames); their fields are sums
// over edges.
#include "physics/contact/rigid/plane_field.hpp"
#include "physics/contact/rigid/rigid_checks.hpp"
#include "physics/contact/rigid/rigid_partner.hpp"
#include "physics/contact/rigid/segment_field.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace meniscus {
namespace {

using Point = Vec<2>;

struct Edge {
  Point begin, tangent, normal;
  Real length;
  Point normal_before, normal_after;  ///< normals of the neighbouring edges
};

std::vector<Edge> edges_of(const std::vector<Point>& polygon) {
  const std::size_t n = polygon.size();
  if (n < 3) throw InputError("a rigid polygon needs at least 3 vertices");
  std::vector<Edge> edges(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Point along = polygon[(i + 1) % n] - polygon[i];
    if (!(along.norm() > 0 && std::isfinite(along.norm())))
      throw InputError(
          "two neighbouring vertices of a rigid polygon are the same, or one is not "
          "finite");
    Edge& edge = edges[i];
    edge.begin = polygon[i];
    edge.length = along.norm();
    edge.tangent = along / edge.length;
    edge.normal = {edge.tangent.y(), -edge.tangent.x()};  // the material is on the left
  }
  for (std::size_t i = 0; i < n; ++i) {
    edges[i].normal_before = edges[(i + n - 1) % n].normal;
    edges[i].normal_after = edges[(i + 1) % n].normal;
  }
  return edges;
}

/// The nearest point of the surface, the outward normal there, and the signed distance.
struct Foot {
  Point place, normal;
  Real distance;
};

class Polygons final : public RigidPartner<2> {
 public:
  Polygons(const ContactLaw& law, Real beta, const std::vector<std::vector<Point>>& polygons)
      : law_(law), beta_(beta), plane_(law), core_(law.guard * law.sigma0) {
    for (const std::vector<Point>& polygon : polygons) {
      const std::vector<Edge> edges = edges_of(polygon);
      edges_.insert(edges_.end(), edges.begin(), edges.end());
    }
    if (edges_.empty()) throw InputError("a rigid partner of polygons needs at least one of them");
  }

  Real distance(const Point& x) const override { return foot(x).distance; }

  RigidField<2> field(const Point& x) const override {
    const Foot f = foot(x);
    return f.distance < core_ ? continued(f) : exact(x);
  }

  LaneField<2> fields(const LanePlace<2>& x, int points) const override {
    const Lanes distance = distances(x);
    if (any(distance.v < core_)) return RigidPartner<2>::fields(x, points);
    LaneField<2> f{};
    f.distance = distance;
    for (const Edge& edge : edges_) {
      const auto [along, above] = from_edge(edge, x);
      const LaneSegmentField part = segment_field(law_, -along, edge.length - along, above);
      for (int i = 0; i < 2; ++i) {
        const Real normal = beta_ * edge.normal[i];
        at(f.S, i) += normal * part.u;
        for (int j = 0; j < 2; ++j)
          at(at(f.grad_S, i), j) +=
              normal * (part.psi_r[0] * edge.tangent[j] + part.psi_r[1] * edge.normal[j]);
      }
    }
    f.U = f.grad_S[0][0] + f.grad_S[1][1];
    return f;
  }

  /// Signed distances of four positions, as foot() computes them. If the nearest point of a lane is
  /// a corner, lanes are computed one by one.
  Lanes distances(const LanePlace<2>& x) const override {
    Lanes least = unbounded, signed_distance = least, corner = Lanes::zero();
    for (const Edge& edge : edges_) {
      const auto [along, above] = from_edge(edge, x);
      const Lanes s = min(max(along, 0.0), edge.length), beside = along - s;
      const Lanes square = beside * beside + above * above;
      const auto nearer = square.v < least.v;
      least = select(nearer, square, least);
      signed_distance = select(nearer, above, signed_distance);
      corner = select(nearer, beside * beside, corner);
    }
    return any(corner.v > 0.0) ? RigidPartner<2>::distances(x) : signed_distance;
  }

 private:
  /// Coordinates relative to the beginning of an edge: along the edge, and along its normal.
  static std::pair<Lanes, Lanes> from_edge(const Edge& edge, const LanePlace<2>& x) {
    const Lanes a = x[0] - edge.begin[0], b = x[1] - edge.begin[1];
    return {edge.tangent[0] * a + edge.tangent[1] * b, edge.normal[0] * a + edge.normal[1] * b};
  }

  /// The field S = beta sum m INT u dl, grad S = beta sum m (x) INT psi r dl, summed over the
  /// edges.
  RigidField<2> exact(const Point& x) const {
    RigidField<2> sum{0, Point::Zero(), Mat<2>::Zero()};
    for (const Edge& edge : edges_) {
      const Point from = x - edge.begin;
      const Real along = edge.tangent.dot(from);
      const SegmentField f =
          segment_field(law_, -along, edge.length - along, edge.normal.dot(from));
      sum.S += beta_ * f.u * edge.normal;
      sum.grad_S +=
          beta_ * edge.normal * (f.psi_r[0] * edge.tangent + f.psi_r[1] * edge.normal).transpose();
    }
    sum.U = sum.grad_S.trace();
    return sum;
  }

  /// The field below the smallest gap. It continues the field at the smallest gap above the foot in
  /// the same way as for a half plane. The gradient is exact over straight edges and approximate
  /// around corners.
  RigidField<2> continued(const Foot& f) const {
    RigidField<2> sum = exact(f.place + core_ * f.normal);
    const Real d = f.distance - core_, U = plane_.U(core_);
    sum.S += d * (sum.grad_S * f.normal) +
             beta_ * (plane_.S(f.distance) - plane_.S(core_) - U * d) * f.normal;
    sum.grad_S += beta_ * (plane_.U(f.distance) - U) * f.normal * f.normal.transpose();
    sum.U = sum.grad_S.trace();
    return sum;
  }

  Foot foot(const Point& x) const {
    const Edge* nearest = nullptr;
    Real least = std::numeric_limits<Real>::infinity(), along = 0;
    for (const Edge& edge : edges_) {
      const Point from = x - edge.begin;
      const Real s = std::min(std::max(edge.tangent.dot(from), 0.0), edge.length);
      const Real square = (from - s * edge.tangent).squaredNorm();
      if (square < least) {
        least = square;
        along = s;
        nearest = &edge;
      }
    }
    return foot_on(*nearest, along, x);
  }

  /// The foot on one edge. At a corner, the mean of both normals decides whether x is outside.
  static Foot foot_on(const Edge& edge, Real along, const Point& x) {
    const Point place = edge.begin + along * edge.tangent, from = x - place;
    const Real distance = from.norm();
    const bool corner = (along <= 0 || along >= edge.length) && distance > 0;
    if (!corner) return {place, edge.normal, edge.normal.dot(from)};
    const Point& other = along <= 0 ? edge.normal_before : edge.normal_after;
    const Real sign = from.dot(edge.normal + other) < 0 ? -1 : 1;
    return {place, sign / distance * from, sign * distance};
  }

  ContactLaw law_;
  Real beta_;
  GuardedPlane plane_;
  Real core_;
  std::vector<Edge> edges_;
};

}  // namespace

std::unique_ptr<RigidPartner<2>> rigid_polygons(const ContactLaw& law, Real beta,
                                                const std::vector<std::vector<Vec<2>>>& polygons) {
  require_kernel<2>(law, "polygon");
  return std::make_unique<Polygons>(law, beta, polygons);
}

std::unique_ptr<RigidPartner<2>> rigid_frame(const ContactLaw& law, Real beta, const Vec<2>& low,
                                             const Vec<2>& high, Real thickness) {
  require_positive(high.x() - low.x(), "the inner width of a rigid frame");
  require_positive(high.y() - low.y(), "the inner height of a rigid frame");
  require_positive(thickness, "the thickness of a rigid frame");
  const auto counter_clockwise = [](const Point& a, const Point& b) {
    return std::vector<Point>{a, {b.x(), a.y()}, b, {a.x(), b.y()}};
  };
  std::vector<Point> inside = counter_clockwise(low, high);
  std::reverse(inside.begin(), inside.end());  // the opening of a frame is a hole
  std::vector<std::vector<Point>> polygons{inside};
  if (std::isfinite(thickness))
    polygons.push_back(
        counter_clockwise(low - Point::Constant(thickness), high + Point::Constant(thickness)));
  return rigid_polygons(law, beta, polygons);
}

}  // namespace meniscus
