// The exact check of a proof over connectivities, lemma by lemma: independent of the program that found it.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "feasibility/sight.hpp"
#include "temper/detail/connectivity.hpp"

namespace temper {

using ProofEdge = ConnectivityProof::Edge;
using Lemma = ConnectivityProof::Lemma;

[[nodiscard]] inline ProofEdge edge_between(VertexId a, VertexId b) { return {std::min(a, b), std::max(a, b)}; }

class ProofChecker {
 public:
  ProofChecker(const Mesh& mesh, const Sight& sight, Constraints constraints)
      : mesh_(mesh), sight_(sight), constraints_(constraints) {}

  /// Checks a lemma. Earlier lemmas are given, and taken for proved.
  [[nodiscard]] CertificateCheck check(const Lemma& lemma, std::span<const Lemma> earlier) const;

 private:
  [[nodiscard]] CertificateCheck check_sum_of(const Lemma& lemma) const;
  [[nodiscard]] CertificateCheck check_cases(const Lemma& lemma, std::span<const Lemma> earlier) const;
  [[nodiscard]] bool has(const Lemma& lemma, VertexId a, VertexId b) const;
  [[nodiscard]] bool is_of(const Lemma& lemma, const WeightConstraint& c) const;
  [[nodiscard]] bool is_crossed(const Lemma& lemma, VertexId a, VertexId b) const;

  const Mesh& mesh_;
  const Sight& sight_;
  Constraints constraints_;
};

}  // namespace temper
