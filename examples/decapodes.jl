# Gives a dual complex of CombinatorialSpaces.jl the orthocenters and weighted midpoints of temper.
#
#   python3 examples/python/combinatorial_spaces.py better.vtu dual
#   julia decapodes.jl dual
#
# Not run by the tests: Julia and its packages are not in Debian.
using CombinatorialSpaces, DelimitedFiles, GeometryBasics
const Point = Point3{Float64}
read_csv(name) = readdlm(joinpath(ARGS[1], name), ','; skipstart=1)

points, edges, triangles = read_csv("points.csv"), read_csv("edges.csv"), read_csv("triangles.csv")
s = EmbeddedDeltaSet2D{Bool,Point}()
add_vertices!(s, size(points, 1), point=[Point(p...) for p in eachrow(points)])
for t in eachrow(triangles)
    glue_sorted_triangle!(s, Int(t[1]), Int(t[2]), Int(t[3]))
end
orient!(s)
sd = EmbeddedDeltaDualComplex2D{Bool,Float64,Point}(s)
subdivide_duals!(sd, Circumcenter())          # makes all dual points and measures; the points are replaced now

place(table, n) = Dict(Tuple(sort(Int.(r[1:n]))) => Point(r[n+1:n+3]...) for r in eachrow(table))
at_edge, at_triangle = place(edges, 2), place(triangles, 3)
for e in 1:ne(sd)
    sd[edge_center(sd, e), :dual_point] = at_edge[Tuple(sort([src(sd, e), tgt(sd, e)]))]
end
for t in 1:ntriangles(sd)
    sd[triangle_center(sd, t), :dual_point] = at_triangle[Tuple(sort(collect(triangle_vertices(sd, t))))]
end
CombinatorialSpaces.DiscreteExteriorCalculus.precompute_volumes_2d!(sd, Point)
