// SPDX-License-Identifier: MIT
// Contact by metaballs at rest: two blocks that are pressed together, and a sphere pressed into a block.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "verification/problems.hpp"
#include "verification/support.hpp"

namespace verification {
namespace contact_detail {
namespace {

/// The contact between two bodies in the same arrays, of which the first `first` particles are the lower one.
/// `depth(i)` is the depth in spacings of particle i below the face that may touch. The penalty is four times as stiff
/// as a layer of particles of Young's modulus `young`.
template <int D, class Depth>
hmps::MetaballContact<double, D> contact_between(const Body<D>& body, std::size_t first, double young, Depth&& depth,
                                                 bool rigid_upper) {
  hmps::MetaballContact<double, D> contact(
      {.spacing = body.spacing,
       .density = 1000,
       .stiffness = hmps::PenaltyStiffness::fixed(4 * young / (body.spacing * body.spacing))});
  std::vector<hmps::Index> skin[2], wall[2];
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (depth(i) < 1) skin[i >= first].push_back(static_cast<hmps::Index>(i));
    if (depth(i) < 3) wall[i >= first].push_back(static_cast<hmps::Index>(i));
  }
  const auto rigid = [rigid_upper](hmps::Index) { return rigid_upper; };
  const auto lower = contact.add_organ({.name = "lower", .slaves = skin[0], .masters = wall[0], .prescribed = {}});
  const auto upper = contact.add_organ({.name = "upper", .slaves = skin[1], .masters = wall[1], .prescribed = rigid});
  contact.add_pair(lower, upper);
  return contact;
}

/// The penalty coefficient is fixed and there is no friction, so the step that is passed to contact has no effect.
constexpr double any_step = 1e-9;

Measured press(int n, const Method& method) {
  using Vector = hmps::Vector<double, 2>;
  constexpr double width = 1, height = 0.5, young = 1e6, closing = 0.01;
  const double l0 = height / n;
  const hmps::Box<double, 2> box{Vector(0, -method.held * l0), Vector(width, 2 * height + method.held * l0)};
  auto points = hmps::fill_lattice(box, box, l0, Vector(Vector::Constant(l0 / 2)));
  const auto middle =
      std::stable_partition(points.begin(), points.end(), [&](const Vector& x) { return x[1] < height; });
  const auto first = static_cast<std::size_t>(middle - points.begin());
  const auto law = hmps::LinearElastic<>::from_young_poisson(young, 0.0);
  const auto depth = [points, l0](std::size_t i) { return std::abs(points[i][1] - height) / l0; };
  Body<2> body(l0, points);
  const auto same_block = [first](std::size_t i, std::size_t j) { return (i < first) == (j < first); };
  const hmps::LatticeBonds<double, 2> bonds(body.X(), {.spacing = l0}, same_block);
  auto contact = contact_between<2>(body, first, young, depth, false);
  const auto moves = [&](std::size_t i) { return body.reference[i][1] > 0 && body.reference[i][1] < 2 * height; };
  return with_force(method, body.F(), bonds, law, [&](auto& internal) {
    const auto force = [&](const auto& x, const auto& v, const auto& f) {
      internal(x, v, f);
      contact.add(x, v, body.F(), f, any_step);
    };
    for (std::size_t i = first; i < body.size(); ++i)
      body.position[i][1] -= closing * (body.reference[i][1] > 2 * height ? 1 : 0.5);
    settle(body, force, moves, young * closing * width, 1e-4);
    // The contact alone, column by column.
    body.unload();
    contact.add(body.x(), body.v(), body.F(), body.f(), any_step);
    std::vector<double> column(static_cast<std::size_t>(2 * n), 0);
    for (std::size_t i = first; i < body.size(); ++i)
      column[static_cast<std::size_t>(body.reference[i][0] / l0)] += body.load[i][1] * l0;
    const auto spread = [&](std::size_t edge) {  // over all columns except `edge` at either side
      double mean = 0, squares = 0;
      const auto count = static_cast<double>(column.size() - 2 * edge);
      for (std::size_t k = edge; k + edge < column.size(); ++k) mean += column[k] / count;
      for (std::size_t k = edge; k + edge < column.size(); ++k) squares += std::pow(column[k] - mean, 2) / count;
      return std::pair(mean / 1e3, 100 * std::sqrt(squares) / mean);
    };
    return Measured{l0, body.size(), {spread(0).first, spread(0).second, spread(3).second, column.front() / 1e3}};
  });
}

/// A rigid sphere of 20 mm on a layer of the seed law.
constexpr double sphere = 0.02, thickness = 0.02, half_width = 0.032;

/// Hertz's force for an incompressible half-space, times the factor of Dimitriadis et al. (2002) for a bonded layer of
/// the thickness h: with chi = sqrt(R delta) / h, 1 + 1.133 chi + 1.283 chi^2 + 0.769 chi^3 + 0.0975 chi^4.
double indentation(double delta) {
  const double young = young_of(tissue), poisson = 0.5 - young / (6 * tissue.bulk_modulus());
  const double chi = std::sqrt(sphere * delta) / thickness;
  return 4.0 / 3 * young / (1 - poisson * poisson) * std::sqrt(sphere) * std::pow(delta, 1.5) *
         (1 + chi * (1.133 + chi * (1.283 + chi * (0.769 + chi * 0.0975))));
}

Measured indent(int n, const Method& method) {
  using Vector = hmps::Vector<double, 3>;
  const double l0 = thickness / n;
  const double across = l0 * std::round(half_width / l0);
  const hmps::Box<double, 3> layer{Vector(-across, -across, -thickness - method.held * l0), Vector(across, across, 0)};
  auto points = hmps::fill_lattice(layer, layer, l0, Vector(Vector::Constant(l0 / 2)));
  const std::size_t first = points.size();
  // The sphere consists of three shells, evenly covered by a spiral; the first one lies half a spacing inside the
  // surface.
  const Vector centre(0, 0, sphere);
  for (int shell = 0; shell < 3; ++shell) {
    const double radius = sphere - (shell + 0.5) * l0;
    const int count = static_cast<int>(4 * std::numbers::pi * radius * radius / (l0 * l0));
    for (int k = 0; k < count / 3; ++k) {  // the lower third
      const double z = 1 - (2 * k + 1.0) / count, angle = std::numbers::pi * (3 - std::sqrt(5.0)) * k;
      const double r = std::sqrt(1 - z * z);
      points.push_back(centre + radius * Vector(r * std::cos(angle), r * std::sin(angle), -z));
    }
  }
  const auto depth = [points, first, centre, l0](std::size_t i) {
    return i < first ? (points[i].head<2>().norm() < 0.6 * sphere ? -points[i][2] / l0 : 9.0)
                     : (sphere - (points[i] - centre).norm()) / l0;
  };
  Body<3> body(l0, points);
  const hmps::LatticeBonds<double, 3> bonds(body.X().part(0, first), {.spacing = l0});
  auto contact = contact_between<3>(body, first, young_of(tissue), depth, true);
  const auto moves = [&](std::size_t i) { return i < first && body.reference[i][2] > -thickness; };
  return with_force(method, body.F().part(0, first), bonds, tissue, [&](auto& internal) {
    const auto force = [&](const auto& x, const auto& v, const auto& f) {
      internal(x.part(0, first), v.part(0, first), f.part(0, first));
      contact.add(x, v, body.F(), f, any_step);
    };
    Measured measured{l0, body.size(), {}};
    for (const double delta : {1e-3, 2e-3}) {
      for (std::size_t i = first; i < body.size(); ++i) body.position[i] = body.reference[i] - Vector(0, 0, delta);
      settle(body, force, moves, indentation(delta), 1e-3);
      body.unload();
      contact.add(body.x(), body.v(), body.F(), body.f(), any_step);
      double up = 0;
      for (std::size_t i = first; i < body.size(); ++i) up += body.load[i][2] * body.volume();
      measured.values.push_back(up);
    }
    return measured;
  });
}

}  // namespace
}  // namespace contact_detail

Problem contact_patch() {
  return {
      .name = "contact patch",
      .title = "24. Contact patch",
      .text =
          "Two blocks of 1 x 0.5 m in plane strain, linear, with E = 1 MPa and nu = 0, lie one above the other and "
          "are pressed together by 10 mm. The pressure between them should be 10 kPa everywhere. The penalty is four "
          "times as stiff as a layer of particles.",
      .quantities = {{.name = "mean pressure", .unit = "kPa", .answer = 10, .source = "exact"},
                     {.name = "spread (rms)", .unit = "%", .answer = 0, .source = "exact", .scale = 100},
                     {.name = "spread without three columns at each side",
                      .unit = "%",
                      .answer = 0,
                      .source = "exact",
                      .scale = 100},
                     {.name = "outermost column", .unit = "kPa", .answer = 10, .source = "exact"}},
      .across = "particles up a block",
      .sizes = {5, 10, 15, 20, 30},
      .methods = methods,
      .run = contact_detail::press,
      .remark =
          "The mean is nearly right: the compliance of the penalty and the stiffening by the held faces nearly "
          "cancel. Inside, the pressure is uniform. At the free sides it is not, at any spacing: the wall of "
          "metaballs ends there together with the block that it carries, so the outermost columns carry too little "
          "and the next two too much."};
}

Problem sphere_on_block() {
  using namespace contact_detail;
  return {.name = "sphere",
          .title = "23. Sphere on a layer",
          .text =
              "A rigid sphere of particles, 20 mm in radius, is pressed by 1 and 2 mm into a layer of the paper's "
              "soft tissue, 64 x 64 x 20 mm, which is bonded to its base. The forces are compared with those of "
              "Hertz (0.158 and 0.448 N), corrected for the thickness of the layer as in Dimitriadis et al. (2002).",
          .quantities = {{.name = "force at 1 mm",
                          .unit = "N",
                          .answer = indentation(1e-3),
                          .source = "published",
                          .uncertainty = 0.02 * indentation(1e-3)},
                         {.name = "force at 2 mm",
                          .unit = "N",
                          .answer = indentation(2e-3),
                          .source = "published",
                          .uncertainty = 0.02 * indentation(2e-3)}},
          .across = "particles across the layer",
          .sizes = {6, 8, 10, 12, 16},
          .methods = bulky_methods,
          .run = indent,
          .remark =
              "The contact is too stiff while the indentation is no larger than the spacing; the force approaches "
              "the answer from above as the contact is resolved."};
}

}  // namespace verification
