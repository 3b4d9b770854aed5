#include "energy/elastic_energy.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "element/rest_shell.h"
#include "energy/power_of_two.h"
#include "energy/shell_strain.h"
#include "material/element_hessian.h"
#include "material/matrix3.h"

namespace snapspace {

namespace {

void star_stresses(const VertexStars& stars, int count, const std::int32_t* which, const double* u,
                   double* stresses, double* energies) {
  for (int k = 0; k < count; ++k) {
    const int star = which ? which[k] : k;
    double numbers[ShellArap::kModuli], H[3][3], P[3][3];
    stars.write_numbers(star, numbers);
    numbers[0] = stars.weights[star];
    stars.gradient_of(star, u, H);
    *energies++ = ShellArap::value_and_stress(numbers, H, P);
    for (const auto& row : P)
      for (const double entry : row) *stresses++ = entry;
  }
}

double largest_force(const RestTet& tet, double stiffness) {
  double largest = 0.0;
  for (const auto& row : tet.inverse_edges)
    for (const double entry : row) largest = std::max(largest, std::abs(entry));
  return stiffness * tet.volume * largest;
}

}  // namespace

ElasticEnergy::ElasticEnergy(RestShape shape, MaterialField field)
    : rest(std::move(shape)), material(std::move(field)), force_unit_(1.0), negligible_(0.0) {
  if (!material.fits(rest.tets.size()))
    throw std::invalid_argument("the material has moduli for a different number of tets");
  const TetMaterial view = material.view();
  const int count = material_moduli(view.kind);
  moduli_.resize(rest.tets.size() * count);
  lame_.resize(2 * rest.tets.size());
  double largest = 0.0;
  for (int t = 0; t < tets(); ++t)
    largest = std::max(largest, largest_force(rest.tets[t], view.small_strains(t).stiffness()));
  force_unit_ = power_of_two(largest);
  for (int t = 0; t < tets(); ++t) {
    const double volume = rest.tets[t].volume;
    scale_moduli(view.kind, view.of(t), volume, &moduli_[t * std::size_t(count)]);
    const Lame lame = view.small_strains(t);
    lame_[2 * t] = volume * lame.lam / force_unit_;
    lame_[2 * t + 1] = volume * lame.mu / force_unit_;
    negligible_ += kNegligibleStrain * kNegligibleStrain * volume * lame.mu;
  }
  single_moduli_.assign(moduli_.begin(), moduli_.end());
  if (is_of_stars(view.kind)) stars.emplace(rest, view, material.hats());
}

double ElasticEnergy::value_and_gradient(const double* u, double* gradient,
                                         SweepVisitor& visitor) const {
  using Narrow = Lanes<2>;
  const std::size_t size = 3 * static_cast<std::size_t>(rest.vertex_count);
  visitor.before(0, rest.vertex_count);
  std::vector<Narrow> shape(u, u + size), forces(size);
  const double value = value_and_gradient(shape.data(), forces.data())[0];
  for (std::size_t i = 0; i < size; ++i) gradient[i] = forces[i][0];
  visitor.after(0, rest.vertex_count);
  return value;
}

void ElasticEnergy::hessian_product(const double* u, const double* v, double* product) const {
  std::fill_n(product, 3 * rest.vertex_count, 0.0);
  if (stars) return stars->add_hessian_product(u, v, product);
  const TetMaterial view = material.view();
  for (int t = 0; t < tets(); ++t) {
    const RestTet& tet = rest.tets[t];
    double G[3][3], dF[3][3], dP[3][3];
    displacement_gradient(tet, u, G);
    displacement_gradient(tet, v, dF);
    hessian_times(view, t, G, dF, dP);
    for (auto& row : dP)
      for (double& entry : row) entry *= tet.volume;
    scatter_stress(tet, dP, product);
  }
}

void ElasticEnergy::stresses_at(int count, const std::int32_t* which, const double* u,
                                double* stresses, double* energies) const {
  if (stars) return star_stresses(*stars, count, which, u, stresses, energies);
  const TetMaterial view = material.view();
  const auto numbers = static_cast<std::size_t>(material_moduli(view.kind));
  Densities::with(view.kind, [&]<class Density>() {
    for (int k = 0; k < count; ++k) {
      const int t = which ? which[k] : k;
      double G[3][3], P[3][3];
      displacement_gradient(rest.tets[t], u, G);
      *energies++ = Density::value_and_stress(&moduli_[t * numbers], G, P);
      for (const auto& row : P)
        for (const double entry : row) *stresses++ = entry;
    }
  });
}

void ElasticEnergy::tet_stresses(const double* u, double* stresses, double* energies) const {
  stresses_at(elements(), nullptr, u, stresses, energies);
}

void ElasticEnergy::tet_stresses(const std::vector<std::int32_t>& which, const double* u,
                                 double* stresses, double* energies) const {
  stresses_at(static_cast<int>(which.size()), which.data(), u, stresses, energies);
}

std::vector<double> ElasticEnergy::stiffnesses() const {
  std::vector<double> result(rest.tets.size());
  for (int t = 0; t < tets(); ++t) result[t] = material.view().small_strains(t).stiffness();
  return result;
}

Eigen::Matrix<double, 4, 3> ElasticEnergy::scalar_gradients(int t) const {
  const RestTet& tet = rest.tets[t];
  if (!rest.shell || is_triangle(tet.vertices)) return hat_gradients(tet);
  const HingeVector hinge(rest_numbers(t) + 1);
  Eigen::Matrix<double, 4, 3> result = Eigen::Matrix<double, 4, 3>::Zero();
  for (int j = 0; j < 3; ++j) result(j + 1, 0) = hinge.row[j] * tet.inverse_edges[0][0];
  result(0, 0) = -result.col(0).tail<3>().sum();
  return result;
}

Eigen::SparseMatrix<double> ElasticEnergy::scalar_matrix() const {
  const std::vector<double> stiffness = stiffnesses();
  std::vector<Eigen::Matrix4d> locals;
  locals.reserve(rest.tets.size());
  for (int t = 0; t < tets(); ++t) {
    const Eigen::Matrix<double, 4, 3> gradients = scalar_gradients(t);
    locals.push_back(stiffness[t] * rest.tets[t].volume * gradients * gradients.transpose());
  }
  return rest.assembled(locals);
}

int ElasticEnergy::inverted_tets(const double* u) const {
  if (rest.shell) return 0;
  return static_cast<int>(
      std::count_if(rest.tets.begin(), rest.tets.end(), [&](const RestTet& tet) {
        double G[3][3];
        displacement_gradient(tet, u, G);
        return VolumeChange<double>(G).determinant <= -1.0;
      }));
}

}  // namespace snapspace
