// The evaluation store: exact bits back, refusals, and a search that is killed and resumed.
#include "problems/search/store.h"

#include <sys/wait.h>
#include <unistd.h>

#include <omp.h>
#include <sqlite3.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>

#include "problems/search/random_search.h"
#include "problems/search/search.h"
#include "tests/problems/search_problems.h"
#include "tests/truth/hock_schittkowski.h"

using namespace stillhook;
namespace fs = std::filesystem;

namespace {

class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "stillhook-store-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~Folder() { fs::remove_all(path_); }
  std::string store() const { return (path_ / "evaluations.sqlite").string(); }

 private:
  fs::path path_;
};

const StoreIdentity kIdentity{"0.1.0", "name = \"a case\"\n"};

SearchProblem hs43() { return truth::inequality_problems()[3].problem; }

SearchOptions options() {
  SearchOptions o;
  o.evaluations = 90;
  o.seed = 11;
  return o;
}

/// Search and random sample on one store, as a plan does both.
std::pair<SearchReport, SearchReport> plan(const SearchProblem& problem, EvaluationStore& store) {
  SearchReport found = search(with_store(problem, store, "search"), options());
  SearchOptions sample = options();
  sample.evaluations = 15;
  return {found, random_search(with_store(problem, store, "random"), sample)};
}

/// Ways to search: the sequence without gradients, one solver with gradients, and many starts in several threads.
struct Way {
  const char* name;
  std::function<SearchReport(const SearchProblem&)> run;
};

const std::vector<Way>& ways() {
  static const std::vector<Way> all = {
      {"sequence", [](const SearchProblem& problem) { return search(problem, options()); }},
      {"ipopt",
       [](const SearchProblem& problem) {
         SolveOptions o;
         o.solver = "ipopt";
         return solve(problem, o);
       }},
      {"auto",
       [](const SearchProblem& problem) {
         SolveOptions o;
         o.evaluations = 90;
         // HS43 within these limits of its gradients needs both ways of evaluating it, back and forth.
         SearchProblem partly = problem;
         partly.evaluate_with_gradient = [evaluate = problem.evaluate_with_gradient](const Eigen::VectorXd& x) {
           Evaluation e = evaluate(x);
           e.gradient_valid = e.gradient_valid && (x - vec({0, 1, 2, -1})).norm() < 1.5;
           return e;
         };
         return solve(partly, o);
       }},
  };
  return all;
}

/// A process that dies by itself or is killed. The threads of OpenMP do not survive a fork: it has one only.
template <class Body>
pid_t child_of(Body body) {
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child > 0) return child;
  omp_set_num_threads(1);
  body();
  _exit(7);
}

void wait_for_kill(pid_t child) {
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  REQUIRE(WIFSIGNALED(status));
  REQUIRE(WTERMSIG(status) == SIGKILL);
}

/// Searches in a process that dies by SIGKILL inside its n-th evaluation.
void search_and_die(const Way& way, const std::string& path, int n) {
  wait_for_kill(child_of([&] {
    int calls = 0;
    const SearchProblem problem = watched(hs43(), [&](const auto&, bool) {
      if (++calls == n) kill(getpid(), SIGKILL);
    });
    EvaluationStore store(path, kIdentity, problem);
    way.run(with_store(problem, store, "search"));
  }));
}

/// Searches in a process that is killed some time, up to a millisecond, after its n-th evaluation has begun: in an
/// evaluation, in the insert, in the solver.
void search_and_be_killed(const Way& way, const std::string& path, int n, useconds_t later) {
  int channel[2];
  REQUIRE(pipe(channel) == 0);
  const pid_t child = child_of([&] {
    const SearchProblem slow = watched(hs43(), [&](const auto&, bool) {
      usleep(300);
      if (write(channel[1], "e", 1) != 1) _exit(8);
    });
    EvaluationStore store(path, kIdentity, slow);
    way.run(with_store(slow, store, "search"));
    close(channel[1]);  // it may have come to its end before
    pause();
  });
  close(channel[1]);
  char seen = 0;
  for (int i = 0; i < n && read(channel[0], &seen, 1) == 1; ++i) {
  }
  usleep(later);
  kill(child, SIGKILL);
  wait_for_kill(child);
  close(channel[0]);
}

void check_same(const SearchReport& report, const SearchReport& truth) {
  CHECK(report.best_x == truth.best_x);
  CHECK(report.best.objective == truth.best.objective);
  CHECK(report.best_evaluation == truth.best_evaluation);
  CHECK(report.evaluations == truth.evaluations);
  CHECK(report.gradients == truth.gradients);
  CHECK(report.status == truth.status);
}

}  // namespace

TEST_CASE("an evaluation comes back with the same bits, found by the bits of x") {
  Folder folder;
  const SearchProblem problem = hs43();
  const Eigen::Vector4d x(0.1, -1.0 / 3, 1e-310, 4.999999999999999);
  Evaluation e;
  e.usable = true;
  e.objective = 1.0 / 7;
  e.constraints = Eigen::Vector3d(-1e-300, 0.1 + 0.2, -5e-324);
  e.details = {std::nan(""), -0.0, 1.0 / 3, INFINITY};
  e.message = "with \"quotes\", a ' and an ü";
  e.gradient_valid = true;
  e.objective_gradient = Eigen::Vector4d(1.0 / 3, 2, 3, 4);
  e.constraint_jacobian = Eigen::MatrixXd::Random(3, 4);
  {
    EvaluationStore store(folder.store(), kIdentity, problem);
    CHECK_FALSE(store.find(x, true));
    store.insert(x, e, true, "search", 1.5);
    Evaluation other = e;
    other.objective = 9;
    store.insert(x, other, true, "search", 1.5);  // the first one stays
  }
  EvaluationStore store(folder.store(), kIdentity, problem);
  CHECK(store.size() == 1);
  const std::optional<Evaluation> back = store.find(x, true);
  REQUIRE(back);
  CHECK(back->from_store);
  CHECK(back->usable);
  CHECK(back->objective == e.objective);
  CHECK(back->constraints == e.constraints);
  REQUIRE(back->details.size() == 4);
  CHECK(std::isnan(back->details[0]));
  CHECK(std::signbit(back->details[1]));
  CHECK(back->details[2] == e.details[2]);
  CHECK(back->details[3] == e.details[3]);
  CHECK(back->message == e.message);
  CHECK(back->objective_gradient == e.objective_gradient);
  CHECK(back->constraint_jacobian == e.constraint_jacobian);
  Eigen::Vector4d neighbour = x;
  neighbour[3] = std::nextafter(x[3], 0.0);
  CHECK_FALSE(store.find(neighbour, true));
  CHECK_FALSE(store.find(x, false));  // computed in another way
  store.insert(Eigen::Vector4d(0.0, 0, 0, 0), e, false, "search", 0.0);
  CHECK(store.find(Eigen::Vector4d(-0.0, 0, 0, 0)));
}

TEST_CASE("a store of another case, another version or no store at all is refused in a sentence") {
  Folder folder;
  const SearchProblem problem = hs43();
  { EvaluationStore store(folder.store(), kIdentity, problem); }
  { EvaluationStore store(folder.store(), kIdentity, problem); }  // its own opens again
  CHECK_THROWS_WITH(EvaluationStore(folder.store(), {"0.1.0", "name = \"b\"\n"}, problem),
                    Catch::Contains("another case"));
  CHECK_THROWS_WITH(EvaluationStore(folder.store(), {"0.2.0", kIdentity.problem}, problem),
                    Catch::Contains("stillhook 0.1.0, this is 0.2.0"));
  CHECK_THROWS_AS(EvaluationStore("/nowhere/evaluations.sqlite", kIdentity, problem), StoreError);
  const std::string text = folder.store() + ".txt";
  std::ofstream(text) << std::string(4096, 'x');
  CHECK_THROWS_WITH(EvaluationStore(text, kIdentity, problem), Catch::Contains("not a usable evaluation store"));
}

TEST_CASE("a search answered from the store computes nothing again and ends at the same plan") {
  Folder folder;
  int computed = 0;
  SearchProblem problem = hs43();
  problem.evaluate = [&, evaluate = problem.evaluate](const Eigen::VectorXd& x) {
#pragma omp atomic
    ++computed;
    return evaluate(x);
  };
  EvaluationStore store(folder.store(), kIdentity, problem);
  const auto [found, sample] = plan(problem, store);
  CHECK(computed == store.size());
  CHECK(found.simulations < found.evaluations);  // the start is asked for again by ISRES
  const int before = computed;
  const auto [again, sample_again] = plan(problem, store);
  CHECK(computed == before);
  CHECK(again.simulations == 0);
  CHECK(sample_again.simulations == 0);
  CHECK(again.evaluations == found.evaluations);
  CHECK(again.best_x == found.best_x);
  CHECK(again.best.objective == found.best.objective);
  CHECK(again.best_evaluation == found.best_evaluation);
  CHECK(sample_again.best_x == sample.best_x);
}

TEST_CASE("killed anywhere, a resumed search loses nothing, repeats nothing and ends at the same plan") {
  const SearchProblem problem = hs43();
  for (const Way& way : ways()) {
    Folder undisturbed_folder;
    EvaluationStore undisturbed(undisturbed_folder.store(), kIdentity, problem);
    const SearchReport truth = way.run(with_store(problem, undisturbed, "search"));
    const int count = undisturbed.size();
    for (const int n : {1, count / 2, count - 1}) {
      CAPTURE(way.name, n);
      Folder folder;
      search_and_die(way, folder.store(), n);
      EvaluationStore store(folder.store(), kIdentity, problem);
      CHECK(store.size() == n - 1);  // all but the one under way
      const SearchReport resumed = way.run(with_store(problem, store, "search"));
      check_same(resumed, truth);
      CHECK(resumed.simulations == truth.simulations - (n - 1));
      CHECK(store.size() == count);
    }
  }
}

TEST_CASE("killed from outside at random moments, again and again") {
  const SearchProblem problem = hs43();
  std::mt19937 random(4711);
  for (const Way& way : ways()) {
    CAPTURE(way.name);
    Folder undisturbed_folder, folder;
    EvaluationStore undisturbed(undisturbed_folder.store(), kIdentity, problem);
    const SearchReport truth = way.run(with_store(problem, undisturbed, "search"));
    for (int kill_number = 0; kill_number < 3; ++kill_number)
      search_and_be_killed(way, folder.store(), 1 + static_cast<int>(random() % 6), random() % 1000);
    EvaluationStore store(folder.store(), kIdentity, problem);
    CHECK(store.size() <= undisturbed.size());
    check_same(way.run(with_store(problem, store, "search")), truth);
    CHECK(store.size() == undisturbed.size());
  }
}

TEST_CASE("evaluations with and without gradient are kept apart") {
  Folder folder;
  std::vector<bool> asked;
  const SearchProblem problem = watched(hs43(), [&](const auto&, bool gradient) { asked.push_back(gradient); });
  EvaluationStore store(folder.store(), kIdentity, problem);
  const SearchProblem stored = with_store(problem, store, "search");
  const Eigen::Vector4d x(0.5, 1, 2, -1);
  const Evaluation plain = stored.evaluate(x), full = stored.evaluate_with_gradient(x);
  CHECK_FALSE(plain.gradient_valid);
  CHECK(full.gradient_valid);
  CHECK(store.size() == 2);
  const Evaluation plain_again = stored.evaluate(x), full_again = stored.evaluate_with_gradient(x);
  CHECK(asked == std::vector<bool>{false, true});
  CHECK_FALSE(plain_again.gradient_valid);
  CHECK(full_again.constraint_jacobian == full.constraint_jacobian);
  CHECK(full_again.objective_gradient == full.objective_gradient);

  // Equalities keep their meaning on the way through the store.
  Folder other;
  const SearchProblem equal = truth::hock_schittkowski(71).problem;
  EvaluationStore equal_store(other.store(), kIdentity, equal);
  const SearchProblem equal_stored = with_store(equal, equal_store, "search");
  const Eigen::VectorXd inside = vec({2, 2, 2, 2});  // sum of squares 16 instead of 40
  const double violation = equal_stored.evaluate(inside).violation();
  CHECK(violation == Approx(24.0));
  CHECK(equal_stored.evaluate(inside).violation() == violation);
}

TEST_CASE("a store of an older layout is refused in a sentence") {
  Folder folder;
  const SearchProblem problem = hs43();
  { EvaluationStore store(folder.store(), kIdentity, problem); }
  sqlite3* db = nullptr;
  REQUIRE(sqlite3_open(folder.store().c_str(), &db) == SQLITE_OK);
  REQUIRE(sqlite3_exec(db, "UPDATE meta SET value = '1' WHERE key = 'schema_version'", nullptr, nullptr, nullptr) ==
          SQLITE_OK);
  sqlite3_close(db);
  CHECK_THROWS_WITH(EvaluationStore(folder.store(), kIdentity, problem),
                    Catch::Contains("made by another version of stillhook (layout 1, this one reads layout 2)") &&
                        Catch::Contains("--force"));
}

TEST_CASE("an interrupted evaluation is not stored, one that is not a number is stored as graded") {
  Folder folder;
  SearchProblem problem = hs43();
  problem.evaluate = [](const Eigen::VectorXd& x) {
    Evaluation e;
    e.usable = true;
    e.objective = std::nan("");
    e.constraints = Eigen::Vector3d::Zero();
    e.interrupted = x[0] > 0;
    return e;
  };
  EvaluationStore store(folder.store(), kIdentity, problem);
  const SearchProblem stored = with_store(problem, store, "search");
  stored.evaluate(Eigen::Vector4d(1, 0, 0, 0));
  CHECK(store.size() == 0);
  const Evaluation first = stored.evaluate(Eigen::Vector4d(-1, 0, 0, 0));
  CHECK_FALSE(first.usable);
  CHECK(std::isfinite(first.objective));
  const Evaluation second = stored.evaluate(Eigen::Vector4d(-1, 0, 0, 0));
  CHECK(second.from_store);
  CHECK(second.objective == first.objective);
  CHECK(second.constraints == first.constraints);
}
