// The registry: every figure of the paper that is made again, with what the paper's own shows.
#include "figures.hpp"

#include "reading.hpp"

namespace temper::gallery {
namespace {

constexpr Figure kFigures[] = {
    {1, "Distances in a triangle and its dual",
     "A triangle ijk with its orthocenter o, the weighted midpoints m of its edges, the distances d along the edges "
     "and "
     "h from the edges to o.",
     fig01::make},
    {2, "Signs of the distances",
     "An unweighted obtuse triangle with one h < 0; weighted ones with some d < 0 although all h > 0, and with both; "
     "the "
     "orthocenter can be put anywhere.",
     fig02::make},
    {3, "HOT energy of a triangle with one free vertex",
     "Contours of E_F for ★0, ★1 and ★2 over the position of the free vertex, the other two at (−1, 0) and (1, 0), "
     "without weights: zero where an edge collapses, a saddle for ★1, negative values near the edge for ★0.",
     fig03::make},
    {4, "HOT energy against one weight",
     "Below, E_F for ★0, ★1 and ★2 while one vertex of a triangle with sides 0.5 and 1 changes its weight: ★1 has a "
     "shallow local minimum and falls without bound. Above, the triangles and their duals at that minimum and far out.",
     fig04::make},
    {5, "Distances of the barrier energies",
     "The sub-triangle of an edge with legs d_ij and h_k, by whose area E_F is normalized to make a barrier.",
     fig05::make},
    {6, "Hard barrier energy of one edge",
     "Contours of E_BH for ★1 over (d, h): one minimum, at d = h = ℓ/2, and walls at h = 0, d = 0 and d = ℓ.",
     fig06::make},
    {7, "Pseudo-barrier energy of one edge",
     "Contours of E_BP for ★1 over (d, h): still one minimum, but finite values where h is negative.", fig07::make},
    {8, "Six energies of a triangle with one free vertex",
     "The ★1 energies over the position of the free vertex, the other two at (−1, 0) and (1, 0). E_F and E_T are least "
     "where the vertex meets another; the barriers have one minimum well away from the edge.",
     fig08::make},
    {9, "The best weight of one vertex",
     "Triangles with sides 0.5 and 1 and many angles between them, each with the weight of one vertex that is best for "
     "each ★1 energy, as a circle, and the dual edges that follow.",
     fig09::make},
    {10, "The best weight against the angle",
     "Curves over the angle: the least energy, the weight that reaches it, and the least d and the least h of the "
     "triangle there, for E_BH, E_BHs, E_BP, E_T and E_F.",
     fig10::make},
    {11, "The two horseshoes",
     "The inputs: a sparse horseshoe of five vertices, one of them inside, and a dense one of 7 × 9.", fig11::make},
    {12, "Sparse horseshoe: positions",
     "Positions alone are optimized. Without collapses E_F, E_∂T and E_T bring vertex 4 almost onto vertex 1, E_BP and "
     "E_BHs do not; with collapses every energy removes vertex 4.",
     fig12::make},
    {13, "Sparse horseshoe: weights from iteration 2",
     "Without collapses, and with weights that join in iteration 2, the energies without a barrier still bring "
     "vertices 4 and 1 together; the weights of E_F run away.",
     fig13::make},
    {14, "Sparse horseshoe: weights from iteration 0",
     "With weights from the start the duals change early enough that E_F, E_∂T and E_T may leave the edge open; the "
     "barriers leave it open either way.",
     fig14::make},
    {15, "Sparse horseshoe: collapses, and weights from iteration 2",
     "Explicit collapses happen before the weights join: vertex 4 goes, and four vertices remain.", fig15::make},
    {16, "Dense horseshoe: positions",
     "Positions alone, no collapses: E_∂T draws several pairs of vertices together, E_BP none, though E_BP ends with "
     "more E_F than the input had.",
     fig16::make},
    {17, "A HOT mess",
     "Positions and weights of the dense horseshoe under E_F from iteration 0: within a few iterations the weights are "
     "huge and triangles are inverted.",
     fig17::make},
    {18, "Dense horseshoe: positions and weights",
     "Under E_T and E_BP with weights from iteration 0 the mesh stays good, without collapses and before flips.",
     fig18::make},
    {19, "Collapses in the first inner iterations",
     "Positions and collapses under E_∂T, iterations 0 to 3: which vertices go, and that the ones they would have met "
     "stay where they are.",
     fig19::make},
    {20, "The outer loop oscillates",
     "The mesh when the inner iterations have converged, and the same after flips, for several outer iterations: the "
     "last two repeat for ever, vertices a and b going to and fro.",
     fig20::make},
    {21, "The energy along the way of vertex a",
     "E_∂T of the patch of vertex a along its searches, to the right and back: extrapolated beyond the flip it goes on "
     "falling, with the flip carried out it rises, so that the flip point is a minimum of the true energy.",
     fig21::make},
    {22, "Steps limited by the next flip converge",
     "The mesh that the oscillation gives way to when a search stops at the point of flipping, flips, and goes on.",
     fig22::make},
    {23, "Weights over the oscillating horseshoe: nine policies",
     "Final meshes of optimizing the weights under E_∂T: flips at once or deferred, weights at once or deferred, steps "
     "unlimited, just after or before the flip.",
     fig23::make},
    {24, "Weights over the oscillating horseshoe: energies",
     "The energy by iteration of the nine policies: deferred weights oscillate, and hidden vertices show as jumps.",
     fig24::make},
    {25, "Weights and positions over the oscillating horseshoe",
     "Positions and weights under E_∂T with deferred flips give a HOT mess; with steps limited by flips, or under E_T, "
     "a good mesh.",
     fig25::make},
    {26, "High heat: collapses",
     "E_BP with the short-edge rule: four collapses in the first outer iteration, a fifth after flips in the third.",
     fig26::make},
    {27, "High heat: outer iterations", "The mesh and its weights in outer iterations 0, 1 and 5 under E_BP.",
     fig27::make},
    {28, "High heat: the left foot", "A closer look at the flips near the left foot in the same iterations.",
     fig28::make},
    {29, "High heat: final meshes", "Where E_BP and E_BHs end, with collapses, positions, weights and flips.",
     fig29::make},
    {30, "The patch test: positions",
     "Vertices that go because their patch is better without them, by iteration, under E_BP and positions alone; a "
     "coarse mesh of good quality remains.",
     fig30::make},
    {31, "The patch test: positions and weights", "The same with weights: more vertices go, and later.", fig31::make},
    {32, "Summary",
     "Which energies end in a good mesh, in nearly coincident vertices or in a HOT mess, with and without weights and "
     "collapses.",
     fig32::make},
};

}  // namespace

std::span<const Figure> figures() { return kFigures; }

Page make(const Figure& figure, Effort effort) {
  Page page = figure.make(effort);
  page.settings = take_run_settings();
  return page;
}

}  // namespace temper::gallery
