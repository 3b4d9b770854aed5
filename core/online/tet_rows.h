#pragma once
#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "online/local_modes.h"
#include "online/row_clusters.h"
#include "simd/lanes.h"
#include "simd/number_pairs.h"

namespace snapspace::online {

/// The energies of tets as functions of their displacement gradients, a block at a time: one tet in
/// each lane.
class TetEnergies {
 public:
  using Tets = Lanes<kWideLanes>;

  /// Returns the energies of a block's tets at their displacement gradients G, and sets their
  /// stresses P.
  virtual Tets block_energy(int block, const Tets G[3][3], Tets P[3][3]) const = 0;
  /// Sets the Hessians C of a block's tets with respect to their displacement gradients.
  virtual void block_curvatures(int block, const Tets G[3][3], Tets C[9][9]) const = 0;

 protected:
  TetEnergies() = default;
  TetEnergies(const TetEnergies&) = default;
  TetEnergies& operator=(const TetEnergies&) = default;
  ~TetEnergies() = default;
};

/// The linear maps G_e (9 x d) from reduced coordinates to the displacement gradients of few tets,
/// and their transposes from stresses to reduced forces. One tet per SIMD lane, a block of kWidth
/// tets at a time. In clusters, G_e is the product of a map from few local coordinates and one that
/// all tets of the cluster share.
/// An energy reads each map once from memory, which takes most of the time. So entries are rounded
/// to 2^-21, two in a word (simd/number_pairs.h): a tiny change of the modes. All arithmetic is in
/// double precision, so that value and gradient match to full precision; in single precision line
/// searches get stuck in noise. Allocates no memory after construction.
class TetRows {
 public:
  static constexpr int kWidth = kWideLanes;
  using Tets = Lanes<kWidth>;

  /// @param rows  tets x 9 x dimension; entry 3 a + b of the second index is d u_a / d x_b. With
  ///              clusters one after the other, tets x 9 x rank
  TetRows(int dimension, int tets, const float* rows, const RowClusters& clusters = {});

  /// How many words an evaluation reads.
  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] int dimension() const { return dimension_; }
  [[nodiscard]] int capacity() const { return capacity_; }
  [[nodiscard]] int tets() const { return tets_; }
  [[nodiscard]] int blocks() const { return (tets_ + kWidth - 1) / kWidth; }
  /// Number of tets in a block; the last block may have unused lanes.
  [[nodiscard]] int lanes(int block) const { return std::min(kWidth, tets_ - block * kWidth); }

  /// Restricts evaluations to the blocks for which active(block) holds; initially to all.
  template <class Active>
  void set_active(Active active) {
    active_.clear();
    for (int block = 0; block < blocks(); ++block)
      if (active(block)) active_.push_back(block);
  }

  /// Restricts the maps to the first coordinates, 1 <= dimension <= capacity.
  void set_dimension(int dimension);

  /// Sets q (d), and resets all forces to zero.
  void begin(const double* q);

  /// The sum of the energies of half 0 or 1 of the active blocks; adds their forces. The halves may
  /// be summed on two threads.
  double sum(int half, const TetEnergies& energies);
  /// Writes the sum of all forces (d), of both halves.
  void end(double* gradient) const;

  /// Adds the Hessian of half 0 or 1 to the lower triangle of `hessian` (d x d).
  void add_hessian(int half, const TetEnergies& energies, double* hessian);

  /// Writes the Hessians (tets x 9 x 9) or the stresses (tets x 9) of all tets, active or not.
  void store_curvatures(const TetEnergies& energies, float* to);
  void store_stresses(const TetEnergies& energies, float* to);

 private:
  /// All tets are in one cluster without modes if their maps are of q itself.
  struct Cluster {
    int first, end;     ///< its first block, and the one after its last
    int rank, pairs;    ///< numbers of local coordinates, and of pairs of these
    int stride;         ///< pairs of a block's words
    std::size_t words;  ///< where its words begin
    LocalModes modes;   ///< empty if local coordinates are q itself

    [[nodiscard]] bool is_local() const { return modes.twins() > 0; }
  };
  /// What half of an evaluation works on.
  struct Half {
    std::vector<double> local;     ///< local coordinates of the present cluster, or q
    std::vector<Tets> local_sums;  ///< sums of the forces of these coordinates
    std::vector<Tets> sums;        ///< sums of the forces of q, lane by lane
    std::vector<LocalModes::Pack> packs;
    std::vector<double> hessian, modes, product;  ///< work arrays of the present cluster
  };

  [[nodiscard]] std::span<const int> blocks_of(int half) const {
    const std::size_t middle = active_.size() / 2;
    return half == 0 ? std::span(active_).first(middle) : std::span(active_).subspan(middle);
  }

  /// Calls act(cluster, block, G) for ascending blocks, with the displacement gradients of their
  /// tets at q, and leave(cluster) after the last one of each cluster.
  template <class Act, class Leave>
  void visit(Half& work, std::span<const int> blocks, const Act& act, const Leave& leave) {
    const Cluster* cluster = nullptr;
    for (const int block : blocks) {
      if (!cluster || block >= cluster->end) {
        if (cluster) leave(*cluster);
        cluster = cluster ? cluster : clusters_.data();
        while (block >= cluster->end) ++cluster;
        enter(*cluster, work);
      }
      Tets G[3][3];
      gradients(*cluster, work, block, G);
      act(*cluster, block, G);
    }
    if (cluster) leave(*cluster);
  }

  void allocate(Half& half) const;
  /// Sets the cluster's local coordinates at q, and resets their forces to zero.
  void enter(const Cluster& cluster, Half& work) const;
  /// Displacement gradients of a block's tets at the local coordinates.
  void gradients(const Cluster& cluster, const Half& work, int block, Tets G[3][3]) const;
  /// Adds the forces of a block's stresses to those of the local coordinates.
  void add_stresses(const Cluster& cluster, Half& work, int block, const Tets P[3][3]) const;
  /// Adds the forces of the local coordinates to those of q.
  void add_forces(const Cluster& cluster, Half& work) const;
  /// Adds a block's part G_e^T curvature G_e to the lower triangle of `hessian`, with respect to
  /// the local coordinates (rank x rank).
  void add_curvatures(const Cluster& cluster, int block, const Tets curvature[9][9],
                      double* hessian) const;
  /// Adds the cluster's Hessian with respect to the local coordinates, if they are not q itself, to
  /// that with respect to q.
  void add_local_hessian(const Cluster& cluster, Half& work, double* hessian) const;

  [[nodiscard]] const Tets* words(const Cluster& cluster, int block) const {
    return words_.data() + cluster.words +
           static_cast<std::size_t>(block - cluster.first) * 9 * cluster.stride;
  }

  int capacity_, dimension_;
  int pairs_;  // number of pairs of coordinates, for the current dimension
  int tets_;
  std::vector<int> all_, active_;  // blocks, ascending
  std::vector<Cluster> clusters_;
  std::vector<Tets> words_;  // block, pair of local coordinates, entry of G; an odd last one is
                             // paired with zeros
  std::vector<double> coordinates_;  // q, and a zero if d is odd
  Half halves_[2];
};

inline double lane_sum(const TetRows::Tets& pack) {
  double sum = 0.0;
  for (int lane = 0; lane < TetRows::kWidth; ++lane) sum += pack[lane];
  return sum;
}

}  // namespace snapspace::online
