#pragma once
// Expressions: a hash-consed graph in an arena.
//
// Every distinct expression exists once; equal expressions have equal node numbers, so comparing is comparing
// numbers. Children are always older than their parents, so a pass over the nodes in order is a bottom-up
// traversal, nothing recurses to destroy it, and sharing keeps derivatives from swelling.
//
// Canonical forms are made by the operators themselves: sums and products are flat, sorted and without like
// terms, numbers are folded, powers of one base are joined, sin(-x) = -sin(x), cos(-x) = cos(x). Nothing is
// multiplied out; that and every rewrite by an identity is simplify.hpp's.

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/expr/length.hpp"
#include "core/expr/node.hpp"
#include "core/expr/node_index.hpp"

namespace qdot {

class BracketMemory;
class Graph;
struct Scaled;

/// Handle to a node: cheap to copy, compared by structure. It must not outlive its graph.
class Expression {
 public:
  Expression() = default;
  Expression(Graph& graph, NodeId id) : graph_(&graph), id_(id) {}
  [[nodiscard]] Graph& graph() const { return *graph_; }
  [[nodiscard]] NodeId id() const { return id_; }
  [[nodiscard]] const Node& node() const;
  [[nodiscard]] bool is_zero() const;
  [[nodiscard]] bool is_one() const;
  /// The number it is, or null.
  [[nodiscard]] const Number* number() const;

  friend bool operator==(const Expression& a, const Expression& b) { return a.id_ == b.id_; }
  friend Expression operator+(const Expression& a, const Expression& b);
  friend Expression operator-(const Expression& a, const Expression& b);
  friend Expression operator-(const Expression& a);
  friend Expression operator*(const Expression& a, const Expression& b);
  friend Expression operator/(const Expression& a, const Expression& b);
  friend Expression operator*(const Number& a, const Expression& b);

 private:
  Graph* graph_{nullptr};
  NodeId id_{0};
};

/// The arena. Copying it copies all nodes under the same numbers: adopt() then moves handles over.
/// Nodes are bounded (`max_nodes`); passing the bound throws Error(too_large).
class Graph {
 public:
  static constexpr std::size_t max_nodes = 200'000;

  Graph();
  Graph(const Graph& other);
  Graph(Graph&& other) noexcept;
  Graph& operator=(const Graph& other);
  Graph& operator=(Graph&& other) noexcept;
  ~Graph();
  [[nodiscard]] Expression number(const Number& value);
  /// The symbol `name`, made on first use. A difference leads with the symbol that was made first:
  /// theta - gamma.
  [[nodiscard]] Expression symbol(std::string_view name);
  [[nodiscard]] Expression sum(std::span<const Expression> terms);
  [[nodiscard]] Expression product(std::span<const Expression> factors);
  [[nodiscard]] Expression power(const Expression& base, const Number& exponent);
  [[nodiscard]] Expression call(Function function, const Expression& argument);
  /// The same expression of a graph that this one was copied from.
  [[nodiscard]] Expression adopt(const Expression& e) { return {*this, e.id()}; }

  [[nodiscard]] const Node& node(NodeId id) const { return nodes_[id]; }
  [[nodiscard]] const Length& length(NodeId id) const { return lengths_[id]; }
  [[nodiscard]] std::size_t size() const { return nodes_.size(); }

  /// What simplify() made of an expression: it is asked the same again, as of both M_ij and M_ji.
  [[nodiscard]] std::optional<Expression> simplified(const Expression& e);
  void keep_simplified(const Expression& e, const Expression& form) {
    simplified_.emplace(e.id(), form.id());
  }

  /// What factored_form() made of brackets. Copies of the graph start without.
  [[nodiscard]] BracketMemory& brackets();
  void forget_brackets();

 private:
  friend Expression operator*(const Number& a, const Expression& b);
  friend Scaled split_coefficient(const Expression& e);

  [[nodiscard]] Expression intern(Node node);
  /// coefficient times what a product can have for its factors, in their order.
  [[nodiscard]] Expression scaled(const Number& coefficient, std::vector<NodeId> factors);

  std::deque<Node> nodes_;  // a deque: references to nodes stay good while nodes are added
  std::vector<Length> lengths_;
  NodeIndex index_;
  std::unordered_map<NodeId, NodeId> simplified_;
  std::unique_ptr<BracketMemory> brackets_;
};

/// What is compared to find the shorter of two forms: an operation counts two, a coefficient that is not a
/// whole number one.
[[nodiscard]] std::size_t written_length(const Expression& e);

/// Children of a node, in order; as long as the node is there.
[[nodiscard]] std::span<const NodeId> children(const Node& node);

/// e = coefficient * rest, rest without a numeric coefficient (1 for a number).
struct Scaled {
  Number coefficient;
  Expression rest;
};
[[nodiscard]] Scaled split_coefficient(const Expression& e);

/// e = base^exponent (exponent 1 for anything but a power).
struct Raised {
  Expression base;
  Number exponent;
};
[[nodiscard]] Raised split_power(const Expression& e);

[[nodiscard]] Expression pow(const Expression& base, const Number& exponent);
[[nodiscard]] Expression pow(const Expression& base, const Expression& exponent);
[[nodiscard]] Expression sqrt(const Expression& e);
[[nodiscard]] Expression sin(const Expression& e);
[[nodiscard]] Expression cos(const Expression& e);

/// All nodes below and including the roots, children before parents.
[[nodiscard]] std::vector<NodeId> reachable(const Graph& graph, std::span<const NodeId> roots);

/// Whether `symbol` occurs in e.
[[nodiscard]] bool depends_on(const Expression& e, const Expression& symbol);
[[nodiscard]] bool depends_on(const Expression& e, std::span<const Expression> symbols);

}  // namespace qdot
