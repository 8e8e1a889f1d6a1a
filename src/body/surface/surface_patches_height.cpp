// SPDX-License-Identifier: BSD-3-Clause
// Height of the centroid of the volume that patches enclose.
#include "body/surface/patch_sums.hpp"
#include "kernel/row_sums.hpp"
#include "numbers/dense.hpp"

namespace meniscus {
namespace {

/// Volume and integral of the height over it.
template <class T>
struct VolumeAndMoment {
  T volume, moment;
  friend VolumeAndMoment operator+(const VolumeAndMoment& a, const VolumeAndMoment& b) {
    return {a.volume + b.volume, a.moment + b.moment};
  }
};

}  // namespace

template <int D>
template <class T>
T SurfacePatches<D>::group_moment(const Vec<D>& along, const Corners<T>& place, T* gradient) const {
  return group_sum(place, gradient,
                   [&](Real weight, const Vector<T>& p, const Vector<T>& m, Vector<T>& by_place,
                       Vector<T>& by_normal) -> T {
                     if (revolved_) {
                       const T disk = std::numbers::pi * weight * p[0] * p[0],
                               level = along[1] * p[1];
                       by_place.fill(T(0.0));
                       by_normal.fill(T(0.0));
                       by_place[0] = 2 * std::numbers::pi * weight * p[0] * m[0] * level;
                       by_place[1] = along[1] * disk * m[0];
                       by_normal[0] = disk * level;
                       return disk * level * m[0];
                     }
                     const Real share = weight / (D + 1);
                     T height = along[0] * p[0];
                     for (int i = 1; i < D; ++i) height += along[i] * at(p, i);
                     const T through = dot(p, m);
                     for (int i = 0; i < D; ++i) {
                       at(by_place, i) = share * (height * at(m, i) + along[i] * through);
                       at(by_normal, i) = share * height * at(p, i);
                     }
                     return share * height * through;
                   });
}

template <int D>
Real SurfacePatches<D>::height(const Vec<D>& along, const NodalVector* u) const {
  NodalVectors x(X_.size());
  place(u, x);
  const auto all = parallel_sum(group_count(), VolumeAndMoment<Real>{0, 0}, [&](Index g) {
    const Corners<Lanes> of_group = corners(g, x);
    return VolumeAndMoment<Real>{sum_of_patches(g, group_volume<Lanes>(of_group, nullptr)),
                                 sum_of_patches(g, group_moment<Lanes>(along, of_group, nullptr))};
  });
  return along.dot(vector_at<D>(x, 0)) + all.moment / all.volume;
}

template <int D>
Real SurfacePatches<D>::follow_height(const Vec<D>& along) {
  if (!chunk_sums_.division().has_some()) return 0;
  volume_gradient_.resize(gradient_.size());
  const auto all = parallel_sum(group_count(), VolumeAndMoment<Real>{0, 0}, [&](Index g) {
    const Corners<Lanes> of_group = corners(g, x_);
    const auto begin = static_cast<std::size_t>(g) * nodes * D;
    return VolumeAndMoment<Real>{
        sum_of_patches(g, group_volume(of_group, volume_gradient_.data() + begin)),
        sum_of_patches(g, group_moment(along, of_group, gradient_.data() + begin))};
  });
  const Real mean = all.moment / all.volume;
  parallel_for(static_cast<Index>(gradient_.size()), [&](Index k) {
    at(gradient_, k) = (at(gradient_, k) - mean * at(volume_gradient_, k)) / all.volume;
  });
  return along.dot(vector_at<D>(x_, 0)) + mean;
}

template <int D>
void SurfacePatches<D>::add_height_gradient_change(const Vec<D>& along, const NodalVector* u,
                                                   const NodalVector* du, Real factor,
                                                   const ForceVector& force) {
  NodalVectors x(X_.size());
  place(u, x);
  const NodalVectors dx = changes(x, du);
  const VolumeAndMoment<Dual<Real>> zero{Dual<Real>(0.0), Dual<Real>(0.0)};
  const auto all = parallel_sum(group_count(), zero, [&](Index g) {
    const auto of_group = corners(g, x, dx);
    const auto volume = group_volume<Dual<Lanes>>(of_group, nullptr),
               moment = group_moment<Dual<Lanes>>(along, of_group, nullptr);
    return VolumeAndMoment<Dual<Real>>{{sum_of_patches(g, volume.v), sum_of_patches(g, volume.d)},
                                       {sum_of_patches(g, moment.v), sum_of_patches(g, moment.d)}};
  });
  const Dual<Real> mean = all.moment / all.volume, by_moment = factor / all.volume,
                   by_volume = -(by_moment * mean);
  ChangingGradient sum = changing_gradient();
  parallel_for(group_count(), [&](Index g) {
    const auto of_group = corners(g, x, dx);
    std::array<Dual<Lanes>, nodes * D> volume, moment;
    group_volume(of_group, volume.data());
    group_moment(along, of_group, moment.data());
    for (int k = 0; k < nodes * D; ++k)
      sum.set(g * nodes * D + k,
              Dual<Lanes>(by_moment) * at(moment, k) + Dual<Lanes>(by_volume) * at(volume, k));
  });
  add_changes_to_particles(sum, x, du, force);
}

template <int D>
Real SurfacePatches<D>::followed_change(const NodalVector* du) const {
  return chunk_sums_.division().sum(point_count(), 0.0, [&](Index q) {
    return sum(projected(q, at(x_, q), gradient_of_point(q, gradient_)) * value_at(rows_, q, du));
  });
}

template <int D>
ChunkTally<Eigen::Vector3d>& SurfacePatches<D>::followed_moments() {
  chunk_sums_.for_own_chunks([&](int chunk, Index begin, Index end) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (Index q = begin; q < end; ++q)
      sum += cross(spatial(at(x_, q)), spatial(gradient_of_point(q, gradient_)));
    moments_[chunk] = sum;
  });
  return moments_;
}

#define MENISCUS_INSTANTIATE(D)                                                         \
  template Real SurfacePatches<D>::height(const Vec<D>&, const NodalVector*) const;     \
  template Real SurfacePatches<D>::follow_height(const Vec<D>&);                        \
  template void SurfacePatches<D>::add_height_gradient_change(                          \
      const Vec<D>&, const NodalVector*, const NodalVector*, Real, const ForceVector&); \
  template Real SurfacePatches<D>::followed_change(const NodalVector*) const;           \
  template ChunkTally<Eigen::Vector3d>& SurfacePatches<D>::followed_moments();
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
