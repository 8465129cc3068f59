#include "api/answers/check/diagnosis.hpp"

#include <algorithm>
#include <set>

#include "core/expr/print/print.hpp"

namespace qdot::api {
namespace {

/// A sentence with the term in the place of {}, and one without it.
struct SlipSentence {
  const char* with_term;
  const char* without;
};
SlipSentence sentence(Slip slip) {
  switch (slip) {
    case Slip::sign:
      return {"The term in {} has the wrong sign.", "A term has the wrong sign."};
    case Slip::factor:
      return {"The number in front of the term in {} is wrong.", "The number in front of a term is wrong."};
    case Slip::dropped_term:
      return {"", "A term is missing."};
    case Slip::whole_sign:
      return {"", "The sign of the whole is wrong."};
    case Slip::whole_factor:
      return {"", "The number in front of the whole is wrong."};
    case Slip::exponent:
      return {"An exponent in the term in {} is wrong.", "An exponent is wrong."};
    case Slip::sine_and_cosine:
      return {"In the term in {} a sine stands for a cosine, or a cosine for a sine.",
              "Sines stand for cosines, or cosines for sines."};
    case Slip::argument:
      return {"The argument of a function in the term in {} is wrong.",
              "The argument of a function is wrong."};
    case Slip::small_angles:
      return {"", "It holds for small angles only."};
    case Slip::gravity:
      return {"", "Gravity points the other way in it."};
    case Slip::moment_of_inertia:
      return {"", "The moment of inertia of a body is that about another point."};
  }
  return {"", ""};
}

/// The factors of a term that change in time; all of them where none does.
Expression changing_part(const FormulaSystem& formula, const Expression& term) {
  const Expression plain = split_coefficient(term).rest;
  const auto* product = std::get_if<Product>(&plain.node());
  if (product == nullptr) return plain;
  std::vector<Expression> changing;
  for (const NodeId id : product->factors) {
    const Expression factor(plain.graph(), id);
    if (formula.vocabulary.varies(factor)) changing.push_back(factor);
  }
  return changing.empty() ? plain : plain.graph().product(changing);
}

/// Whether every factor stands in the submission itself, so that naming it tells nothing new.
bool stands_in(const Expression& part, const Expression& submitted) {
  const NodeId root[]{submitted.id()};
  const std::vector<NodeId> all = reachable(submitted.graph(), root);
  const std::set<NodeId> known(all.begin(), all.end());
  const auto* product = std::get_if<Product>(&part.node());
  if (product == nullptr) return known.contains(part.id());
  return std::ranges::all_of(product->factors, [&](NodeId id) { return known.contains(id); });
}

/// Of several terms that have a symbol in common.
SlipSentence sentence_of_several(Slip slip) {
  if (slip == Slip::sign)
    return {"The terms with {} have the wrong sign.", "Several terms have the wrong sign."};
  if (slip == Slip::dropped_term) return {"", "Several terms are missing."};
  return {"The number in front of the terms with {} is wrong.",
          "The number in front of several terms is wrong."};
}

std::string in_words(const FormulaSystem& formula, const FoundSlip& found, const Expression& submitted) {
  const SlipSentence words = found.shared ? sentence_of_several(found.slip) : sentence(found.slip);
  if ((!found.term && !found.shared) || *words.with_term == '\0') return words.without;
  const Expression part = found.shared ? *found.shared : changing_part(formula, *found.term);
  if (!stands_in(part, submitted)) return words.without;
  std::string text = words.with_term;
  text.replace(text.find("{}"), 2, print(part, Form::text, formula.notation));
  return text;
}

std::optional<Expression> gravity_of(const FormulaSystem& formula) {
  const auto& parameters = formula.scene().parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].name == "g" && !formula.scene().gravity.empty())
      return formula.system.symbols().parameters[i];
  }
  return std::nullopt;
}

}  // namespace

Json diagnosis_json(const FormulaSystem& formula, const Compared& compared, std::uint64_t seed, bool reveal) {
  std::vector<SymbolDomain> symbols = formula.system.domains();
  for (const Expression& lambda : formula.system.symbols().multipliers) symbols.push_back({lambda, {}});
  SlipQuestion question{.submitted = formula.system.with_fixed(compared.submitted),
                        .expected = compared.expected,
                        .accelerations = {},
                        .symbols = symbols,
                        .gravity = gravity_of(formula),
                        .inertia = compared.inertia,
                        .seed = seed};
  if (compared.are_equations) {
    question.accelerations = formula.system.symbols().coordinates.second_rate;
    for (const SymbolDomain& symbol : symbols) {
      if (formula.vocabulary.varies(symbol.symbol)) question.changing.push_back(symbol.symbol);
    }
  }
  const auto found = find_slip(question);
  if (!found) return nullptr;
  Json json{{"slip", name_of(found->slip)}, {"text", in_words(formula, *found, compared.submitted)}};
  if (reveal && found->factor) json["factor"] = found->factor->value();
  return json;
}

}  // namespace qdot::api
