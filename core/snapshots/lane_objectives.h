#pragma once
#include <functional>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include "simd/packs.h"
#include "snapshots/lane_objective.h"
#include "threads/thread_share.h"

namespace snapspace {

/// Makes the objectives of one system for packs of every width, because solvers get narrower
/// towards the end of their work.
class LaneObjectives {
 public:
  template <class Real>
  using Maker = std::function<std::unique_ptr<LaneObjective<Real>>(const ThreadShare& threads)>;

  /// @param masses  of the vertices, for comparing lengths of displacements
  /// @param make    make.template operator()<Real>(threads) is a new LaneObjective<Real> that may
  ///                use these threads, which it refers to
  template <class Make>
  LaneObjectives(std::vector<float> masses, const Make& make)
      : masses_(std::move(masses)), makers_(makers(make, LanePacks())) {}

  [[nodiscard]] const std::vector<float>& masses() const { return masses_; }

  template <class Real>
  [[nodiscard]] std::unique_ptr<LaneObjective<Real>> objective(const ThreadShare& threads) const {
    return std::get<Maker<Real>>(makers_)(threads);
  }

 private:
  template <class... Real>
  static std::tuple<Maker<Real>...> tuple_of(PackList<Real...>);
  using Makers = decltype(tuple_of(LanePacks()));

  template <class Make, class... Real>
  static Makers makers(const Make& make, PackList<Real...>) {
    return {[make](const ThreadShare& threads) -> std::unique_ptr<LaneObjective<Real>> {
      return make.template operator()<Real>(threads);
    }...};
  }

  std::vector<float> masses_;
  Makers makers_;
};

}  // namespace snapspace
