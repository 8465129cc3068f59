#pragma once
// What the symbols of a scene mean to a reader: which are parameters and which coordinates, in which order
// they were declared, and how their names are written.

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace qdot {

/// What a printer knows of the symbols. Velocities, accelerations and momenta are recognized by name:
/// theta_dot, theta_ddot, and p_theta when theta is a coordinate.
struct Notation {
  std::vector<std::string> parameters;   ///< in the order in which products show them; inputs too
  std::vector<std::string> coordinates;  ///< in the same sense
  std::vector<std::pair<std::string, std::string>>
      latex;  ///< name and its LaTeX, where the rules below do not do
};

/// Roles in the order in which a product shows them.
enum class Role { constant, parameter, other, coordinate, velocity, acceleration };

/// A symbol's place in a product: by role, then by order of declaration (undeclared ones last, by name).
struct Place {
  Role role{Role::other};
  std::size_t index{0};
  friend auto operator<=>(const Place&, const Place&) = default;
};

[[nodiscard]] Place place_of(std::string_view name, const Notation& notation);

/// A name taken apart: omega0 is omega with index 0, p_theta is p with index theta, theta_ddot has two dots,
/// mu_hat a hat, m_foot_1 the index foot,1.
struct WrittenName {
  std::string base;
  std::vector<std::string> indices;
  int dots{0};
  bool hat{false};
};

[[nodiscard]] WrittenName written_name(std::string_view name);

/// The letter a name stands for (theta: "θ" in UTF-8; in LaTeX the command is the name itself), or empty.
[[nodiscard]] std::string_view greek_letter(std::string_view name);

/// theta -> \theta, l0 -> l_0, theta_dot -> \dot\theta, p_theta -> p_\theta, mass -> \mathrm{mass}.
[[nodiscard]] std::string latex_name(std::string_view name, const Notation& notation);

/// The same as a presentation MathML element. Names are written by the rules alone: `Notation::latex` is not
/// read.
[[nodiscard]] std::string mathml_name(std::string_view name);

}  // namespace qdot
