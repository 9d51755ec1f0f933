// Uniform grid, SEADS (Fujimoto, Tanaka & Iwata 1986; Arvo & Kirk §5.2)
// J. Amanatides, A. Woo, "A fast voxel traversal algorithm for ray tracing", 1987; J. Cleary, G. Wyvill, "Analysis of an
// algorithm for fast ray tracing using uniform space subdivision", 1988.
//
// Idea       Divide the box of the scene into equal cells, each with a list of the objects in it, whatever the scene
//            looks like. A ray walks from cell to cell in the order in which it pierces them, which takes one
//            comparison of the distances to the next plane along each axis. It ends where a hit lies before the
//            border of the cell it is in.
// Parameters resolution  heterogeneous: cubic cells, which suits flat scenes; cube_root, woo, or explicit as 46x46x3
//            density     cells per object, for a rule; 5, where a cell more costs about as much as the test it saves
//            storage     dense, an array, is the faster; hashed keeps only cells with objects (Arvo & Kirk §5.2), for
//                        sparse scenes at high resolution
//            mailbox     auto: where some object is listed twice
//            assignment  box lists an object in every cell its bounds touch; exact where its surface does: fewer
//                        tests for large slanted objects, a longer build
// Cost       Cleary and Wyvill: steps in proportion to the cube root of the number of cells, and for each its share
//            of the objects, which falls with resolution while steps grow.
// Weak       scenes of varying local complexity (Jevans 1990): one cell then holds the teapot, and a ray walks through
//            the empty stadium.
//
// Exactness  The planes are computed once and serve both to assign objects and to walk; where the ray crosses them is
//            computed from the plane, never by adding up. Where several planes are crossed at one distance, all cells
//            that touch it are visited (grid_walk.h).

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <variant>

#include "accel/core/define_technique.h"
#include "accel/parts/cell_lists.h"
#include "accel/parts/grid_resolution.h"
#include "accel/parts/grid_walk.h"
#include "accel/parts/visit_cells.h"
#include "scenes/core/memory.h"

namespace rayshoot {

namespace {

constexpr const char* kId = "uniform_grid";
constexpr double kDensity = 5;

struct GridConfig {
  ResolutionChoice resolution;
  bool hashed = false;
  MailboxUse mailbox = MailboxUse::automatic;
  bool exact = false;
};

/// Which cells of a grid an object belongs to.
template <class Real>
class CellAssignment {
 public:
  CellAssignment(const Geometry<Real>& geometry, const GridPlanes<Real>& grid, bool exact)
      : geometry_(geometry), grid_(grid), exact_(exact) {}

  /// Call visit(cell) for every cell that the object's bounds touch or, if exact, its surface does.
  template <class Visit>
  void operator()(std::uint32_t object, const Visit& visit) const {
    const CellRange range = grid_.overlapped_by(geometry_.bounds(object));
    if (!exact_ || range.cells() == 1 || !visit_surface(object, range, visit))
      grid_.for_each_cell(range, visit);
  }

  /// An upper bound of the number of those cells. A convex surface passes at most about twice through the
  /// cells along each of the three faces of its bounds.
  double most_cells(std::uint32_t object) const {
    const CellRange range = grid_.overlapped_by(geometry_.bounds(object));
    const double x = range.cells(0), y = range.cells(1), z = range.cells(2);
    return exact_ ? std::min(x * y * z, 2 * (x * y + y * z + z * x)) : x * y * z;
  }

 private:
  /// Halve the block of cells, again and again, where the surface reaches; true when it reaches any.
  template <class Visit>
  bool visit_surface(std::uint32_t object, const CellRange& range, const Visit& visit) const {
    if (!geometry_.overlaps(object, grid_.box(range))) return false;
    if (range.cells() == 1) {
      visit(grid_.number(range.first[0], range.first[1], range.first[2]));
      return true;
    }
    int widest = 0;
    for (int axis = 1; axis < 3; ++axis)
      if (range.cells(axis) > range.cells(widest)) widest = axis;
    CellRange lower = range, upper = range;
    lower.last[widest] = (range.first[widest] + range.last[widest]) / 2;
    upper.first[widest] = lower.last[widest] + 1;
    const bool in_lower = visit_surface(object, lower, visit);
    const bool in_upper = visit_surface(object, upper, visit);
    return in_lower || in_upper;
  }

  const Geometry<Real>& geometry_;
  const GridPlanes<Real>& grid_;
  bool exact_;
};

/// The box to divide. Havran's grids give an object that ends on a plane to the cell above it alone: under his rule for
/// bounds all planes lie lower by less than any object is long, which shows in double precision alone.
template <class Real>
Box<Real> grid_box(const Geometry<Real>& geometry) {
  Box<Real> box = geometry.bounds();
  constexpr Real lowering = 1e-8;
  if (geometry.bounds_rule() == BoundsRule::havran)
    box.lo = box.lo - Vec3<Real>{lowering, lowering, lowering};
  return box;
}

/// Throws InputError unless the grid fits into memory.
template <class Real>
void refuse_too_many_cells(const GridPlanes<Real>& grid, const CellAssignment<Real>& assignment,
                           std::uint32_t objects, bool hashed) {
  using Part = tbb::blocked_range<std::uint32_t>;
  const double references = tbb::parallel_deterministic_reduce(
      Part(0, objects, 4096), 0.0,
      [&](const Part& part, double sum) {
        for (std::uint32_t object = part.begin(); object < part.end(); ++object)
          sum += assignment.most_cells(object);
        return sum;
      },
      std::plus<>());
  const double cells = static_cast<double>(grid.cells());
  const double bytes =
      hashed ? HashedCellLists::bytes_needed(references) : CellLists::bytes_needed(cells, references);
  constexpr double kGibibyte = 1 << 30;
  const auto refuse = [&](const std::string& because) {
    const auto [x, y, z] = grid.resolution();
    return InputError(
        fmt::format("{}: a grid of {}x{}x{} cells with up to {:.3g} references {}; choose a coarser "
                    "resolution{}",
                    kId, x, y, z, references, because, hashed ? "" : " or storage=hashed"));
  };
  if (bytes > physical_memory())
    throw refuse(fmt::format("needs about {:.3g} GiB, and this machine has {:.3g} GiB", bytes / kGibibyte,
                             physical_memory() / kGibibyte));
  if (references > 0xFFFFFFFFu) throw refuse("has more than 2^32 - 1");
}

template <class Real>
class UniformGrid {
 public:
  using Scalar = Real;
  using Config = GridConfig;
  using Scratch = Mailbox;

  static TechniqueInfo info() {
    std::vector<Parameter> parameters = resolution_parameters(kDensity);
    parameters.push_back(choice_parameter("storage", "dense", {"dense", "hashed"},
                                          "an array of all cells, or a hash table of those with objects"));
    parameters.push_back(mailbox_parameter());
    parameters.push_back(
        choice_parameter("assignment", "box", {"box", "exact"},
                         "an object belongs to the cells that its bounds or its surface touch"));
    return {.id = kId,
            .title = "Uniform grid (SEADS) with a 3-D digital differential analyser",
            .family = "grid",
            .survey_section = "5.2",
            .paper = "Fujimoto, Tanaka & Iwata 1986; Amanatides & Woo 1987; Cleary & Wyvill 1988",
            .parameters = parameters};
  }
  static Config configure(const Arguments& arguments) {
    return {.resolution = resolution_choice(arguments, kDensity, kId),
            .hashed = arguments.text("storage") == "hashed",
            .mailbox = mailbox_use(arguments),
            .exact = arguments.text("assignment") == "exact"};
  }

  static UniformGrid build(const BuildInput<Real>& in, const Config& config) {
    UniformGrid technique;
    const std::uint32_t objects = in.geometry.size();
    if (objects == 0) return technique;

    // Divide the box of all objects.
    const Box<Real> bounds = grid_box(in.geometry);
    technique.grid_ =
        GridPlanes<Real>(bounds, config.resolution.for_objects(objects, Vec3d(bounds.hi) - Vec3d(bounds.lo)));
    const CellAssignment<Real> assignment(in.geometry, technique.grid_, config.exact);
    refuse_too_many_cells(technique.grid_, assignment, objects, config.hashed);

    // List the objects of every cell.
    if (config.hashed)
      technique.cells_ = HashedCellLists(objects, assignment);
    else
      technique.cells_ = CellLists(technique.grid_.cells(), objects, assignment);

    if (wants_mailbox(config.mailbox, technique.structure().references, objects))
      technique.mailboxes_ = objects;
    return technique;
  }

  Scratch scratch() const { return Mailbox(mailboxes_); }

  template <class Counter, class L>
  void visit(const Ray<Real>& ray, Scratch& mailbox, Counter count, L& leaf) const {
    visit_objects_of_cells(*this, ray, mailbox, count, leaf);
  }

  /// Hand the objects of the ray's cells to `visit`, cell by cell (visit_cells.h).
  template <class Counter, class Reach, class Visit>
  void visit_cells(const Ray<Real>& ray, Counter count, const Reach& reach, const Visit& visit) const {
    if (grid_.cells() == 0) return;
    const auto walk = [&](const auto& cells) {
      walk_grid(grid_, ray, Crossings<Real>(ray), count, reach,
                [&](std::uint64_t cell) { return visit(cells.objects(cell)); });
    };
    if (const CellLists* dense = std::get_if<CellLists>(&cells_))
      walk(*dense);
    else
      walk(std::get<HashedCellLists>(cells_));
  }

  const UniformGrid& cells(Scratch&) const { return *this; }
  template <class Visit>
  void for_each_cell(const Visit& visit) const {
    std::visit(
        [&](const auto& cells) {
          cells.for_each_list([&](std::uint64_t cell, std::span<const std::uint32_t> objects) {
            visit(grid_.box(grid_.block(cell)), objects.data(), objects);
          });
        },
        cells_);
  }

  StructureStats structure() const {
    return std::visit(
        [&](const auto& cells) -> StructureStats {
          return {.nodes = grid_.cells(),
                  .leaves = grid_.cells(),
                  .empty_leaves = grid_.cells() - cells.occupied(),
                  .references = cells.references(),
                  .bytes = grid_.bytes() + cells.bytes()};
        },
        cells_);
  }

 private:
  GridPlanes<Real> grid_;
  std::variant<CellLists, HashedCellLists> cells_;
  std::uint32_t mailboxes_ = 0;
};

}  // namespace

RAYSHOOT_TECHNIQUE(uniform_grid, UniformGrid)

}  // namespace rayshoot
