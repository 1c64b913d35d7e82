// Every evaluation of a search, on disk: a SQLite file that survives a kill and answers a resumed search.
//
// A store belongs to one problem, described by its identity: everything that an evaluation's result depends on besides
// x (the case as resolved, the files it names, the program's version). An evaluation is found by the exact bits of x.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>

#include "problems/search/problem.h"
#include "sim/error.h"

namespace stillhook {

/// A store that cannot be used: another problem's, another version's, not a store, no room. what() is a sentence.
class StoreError : public Error {
 public:
  using Error::Error;
};

/// What an evaluation depends on besides x.
struct StoreIdentity {
  std::string version;  // of the program
  std::string problem;  // everything else, as text; compared as a whole
};

class EvaluationStore {
 public:
  /// Opens the file, or makes a new one. Throws StoreError if it holds another identity or cannot be opened.
  EvaluationStore(const std::string& path, const StoreIdentity& identity, const SearchProblem& problem);
  ~EvaluationStore();
  EvaluationStore(const EvaluationStore&) = delete;
  EvaluationStore& operator=(const EvaluationStore&) = delete;

  /// The evaluation at exactly x, with from_store set: the one asked for with its gradient, or the one without. These
  /// are two, since they are computed in different ways: were one answered by the other, what is found would depend on
  /// which came first. Safe to call from several threads.
  std::optional<Evaluation> find(const Eigen::VectorXd& x, bool with_gradient = false);
  /// Keeps an evaluation; on return it is on disk. A second one at the same x changes nothing.
  void insert(const Eigen::VectorXd& x, const Evaluation& evaluation, bool with_gradient, const std::string& source,
              double wall_s);

  /// Distinct evaluations held, with and without gradient.
  int size();

 private:
  class Database;
  std::unique_ptr<Database> db_;
};

/// The problem with the store in front: what it holds is answered, the rest is computed and kept (but not an
/// interrupted evaluation). The store must outlive the result.
SearchProblem with_store(const SearchProblem& problem, EvaluationStore& store, const std::string& source);

}  // namespace stillhook
