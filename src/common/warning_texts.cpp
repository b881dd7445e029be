// SPDX-License-Identifier: BSD-3-Clause
#include "common/message_texts.h"

#include <iterator>

namespace pcl_uvol::detail {

namespace {

const MessageText warning_rows[] = {
    // common
    {"repeated_field", "A further field '{field}' is called '{name}'."},
    {"more_repeated_fields",
     "{fields} more {fields|field is|fields are} told apart in the same way."},
    {"points_beyond_float",
     "{points} {points|point has|points have} a coordinate of 3.4e38 or more, which "
     "float does not hold. {points|It counts as a point|They count as points} "
     "without a position."},
    {"rounded_coordinates",
     "Coordinates are rounded to float by up to {rounding:2}, {spacings:2} times "
     "the distance between neighbours (about {spacing:2}): neighbours may fall "
     "together. Parts of the cloud that lie far apart keep their digits in files of "
     "their own."},
    {"rounded_far_points",
     "Coordinates of single points far from the others are rounded to float by up "
     "to {rounding:2}, {spacings:2} times the distance between neighbours (about "
     "{spacing:2})."},
    {"merged_positions",
     "{positions} {positions|position falls|positions fall} together with others "
     "once coordinates are rounded to float, though up to {distance:2} apart: such "
     "points count as duplicates. Parts of the cloud in files of their own keep "
     "more digits."},
    {"conflicting_samples",
     "At {percent} % of the places of samples several lie whose values differ, and "
     "their median is taken: {-where} chooses among them, as in {-where "
     "\"experiment=1\"}."},

    // neighbors
    {"strays",
     "{strays} {strays|point lies|points lie} 1e12 times as far out as most others "
     "and {strays|is|are} left out: {strays|it is|the first is} point {first} at "
     "({x:6}, {y:6}, {z:6})."},
    {"unfilled_box",
     "Samples fill {length} of the side {side} of the box along {axis}: if they "
     "should fill it, its side is wrong."},
    {"samples_beyond_box",
     "Samples extend over {length} along {axis}, and the box has a side of {side}: "
     "they are moved into it by whole sides. If they are not unwrapped positions, "
     "the side is wrong."},

    // interpolation
    {"overshoots",
     "{wild} of the {values} values of {field} lie farther beyond the samples' "
     "range than that is wide: the model overshoots there. The model natural stays "
     "within it."},
    {"invalid_queries",
     "{invalid} of the {queries} queries have no finite coordinates, and no value."},
    {"queries_outside",
     "{outside} of the {queries} queries lie outside of the data: {has_values|their "
     "values rest on no samples around them.|they have no value (NaN).}"},
    {"weak_support",
     "{weak} of the {queries} queries lie in gaps of the sampling or at its rim, or "
     "among samples that do not determine the model: their values rest on little."},
    {"unsure_values",
     "{unsure} of the {values} values of {field} have a standard error above the "
     "spread of the samples: the model does not know the field there. Leaving "
     "samples out tells which one does better."},
    {"no_variogram",
     "The field {field} is the same at all samples: there is no variogram, and "
     "every estimate is that value, with error 0."},
    {"nothing_covered",
     "None of the {tested} held-out samples has a value: each fold is outside of "
     "the samples that remain. The test measures no error. Try: {-extrapolate}, "
     "more folds, or {-validate-by blocks}."},
    {"few_samples_for_choice",
     "There are too few samples to choose a model by: the local fits are taken."},

    // expressions
    {"undefined_field",
     "The field '{field}' is undefined at {undefined} of {points} points, as by a "
     "division by zero or the logarithm of a negative number: they have no value."},
    {"unknown_derivatives",
     "At {unknown} of {points} points the neighbours do not determine the "
     "derivatives, because the standard error is larger than the differences "
     "between values. These points have no value."},
    {"reduced_derivatives",
     "Around {samples} {samples|sample|samples} others lie on few planes or lines: "
     "derivatives "
     "across these count as 0."},

    // isosurface
    {"no_isopoints",
     "No isopoints for {isovalue}: it lies outside the range [{low}, {high}] of "
     "{field}."},
    {"constant_field", "No isopoints for {isovalue}: all values of {field} are {low}."},
    {"lowest_isovalue",
     "No isopoints for {isovalue}: it is the lowest value of {field}, and values "
     "equal to the isovalue count as above."},
    {"replaced_field",
     "The samples' field '{field}' is left out: isopoints have one of that name."},

    // mesh
    {"large_caps",
     "The mesh at {isovalue} has {percent} % of its area in caps at the border of "
     "the samples: if values are {is_lower_outside|higher|lower} outside of the "
     "surface you want, ask for the other outside."},
    {"folds",
     "Of {triangles} triangles {folds} look away from the surface they are "
     "on{is_even| and {slivers} have an angle below 5 degrees|}: the samples are "
     "too sparse, noisy or stretched there; filled gaps help between lines of "
     "samples, a level set in noise, and isopoints without a mesh anyway."},
    {"open_pieces",
     "Of {pieces} pieces {open} are open, or disagree with others about the "
     "outside: they enclose no volume, and only their area is measured."},
    {"vague_measures",
     "Area or volume of {vague} of {surfaces} surfaces are not known to better than "
     "a third: vertices lie that far from where the surface may be."},
    {"missed_samples",
     "At {isovalue} the surface encloses {enclosed} samples, and {beyond} have "
     "values beyond the isovalue: {encloses_more|between samples it is a guess|the "
     "mesh is coarser than clumps of few samples, or leaves them out}. For masses, "
     "take the sum beyond the isovalue."},
    {"kept_unsure_pieces",
     "All pieces of some isovalues ({kept} of {pieces} pieces) have an error as "
     "large as they are. They are kept, since nothing would be left."},
    {"unsure_pieces",
     "{unsure} of {pieces} pieces (area {area} +- {error}) have an error as large "
     "as they are: few samples are around them, or only debris far from the others. "
     "{are_left_out|They are left out of all figures.|Try: {-drop-unsure} "
     "leaves them out of the measures.}"},
    {"flat_surfaces",
     "{flat} of {surfaces} surfaces have no volume, and no samples inside: a mesh "
     "in one plane encloses nothing. If all samples are in one plane, the "
     "isosurface is a curve."},
    {"negative_volumes",
     "The surface looks to the side that it encloses: volumes are negative."},
    {"area_in_gaps",
     "{percent} % of the area lies in gaps between the samples or at their border, "
     "where the samples do not tell whether the surface goes on. Shells and plates "
     "of a few layers of samples look so: if the file has cells, contour the cells "
     "instead."},
    {"points_without_area",
     "{percent} % of the points have no part in the area: they have no normal, "
     "stand at the place of another one, or too few others are around."},
    {"contrary_normals",
     "{percent} % of the points stand among others that look to the other side: "
     "unless sheets of the surface lie closer together than its points, orient the "
     "normals, or areas count twice."},
    {"self_intersections",
     "The surface goes through itself: {pairs} {pairs|pair|pairs} of triangles "
     "intersect, the first at {x:6},{y:6},{z:6}."},
    {"area_without_error",
     "{percent} % of the area has vertices without an estimated error: the errors "
     "of the figures are those of the rest."},

    // levelset
    {"vanished",
     "The level set of {field} at the isovalue {isovalue} has vanished: "
     "{starts_from_values|smoothing took the whole surface away. A larger mu keeps "
     "it.|the values drew the whole start away. They lie on its other sides, if the "
     "wrong side is the outside.}"},
    {"tied_values",
     "Of the values next to the isovalue {isovalue} {percent:2} % are the same: "
     "values in steps, or at a limit, do not tell how noisy they are, and nothing "
     "was smoothed. {-mu 0.1} smooths them."},
    {"not_converged",
     "The level set at {isovalue} has not converged after {steps} "
     "{steps|step|steps}: it still moves by {change:2} spacings per unit of "
     "time.{is_last_stage|| It ended at mu {mu:2}, where {chosen_mu:2} was chosen.}"},
    {"lost_features",
     "Smoothing has taken features away: {lost} {lost|sample that lies|samples that "
     "lie} farther from the isovalue {isovalue} than noise explains {lost|is|are} "
     "on the other side of the surface now. A larger mu than {mu:2} keeps more of "
     "them."},
    {"outliers",
     "{percent:2} % of the samples next to the surface ({outliers}) have values "
     "unlike those of all their neighbours: the level set takes them for outliers "
     "and counts the median of the neighbours instead."},

    // surface
    {"estimated_normals",
     "The cloud has no normals: they were estimated, and the surface is drawn from "
     "both sides."},
    {"bad_splats",
     "{bad} of {splats} splats are left out: they are not finite, have no normal, "
     "tangent or radius, or are larger or farther away than {reach:6}."},
    {"ready_splats",
     "It holds splats, which are drawn as they are: delta and lambda are not used."},

    // multivariate
    {"constant_attribute",
     "The attribute {attribute} is the same everywhere and is left out."},
    {"few_clusters",
     "The rows are in {clusters} {clusters|cluster|clusters}, so there is nothing to "
     "keep apart: the "
     "projection is to their principal axes."},
    {"no_clusters",
     "No cluster found among {points} points: none of at least {min_size} points "
     "stands out from the others by more than chance; a smaller least size may find "
     "some, or all points may be allowed to be a single cluster."},
    {"no_clusters_at_distance",
     "No cluster found among {points} points: none of at least {min_size} points "
     "hangs together at the distance {distance}; a larger distance or a smaller "
     "least size may find some."},
    {"mostly_noise",
     "{noise} of {points} points belong to no cluster: the clusters that were found "
     "tell little about these data."},
    {"clusters_of_rounding",
     "{steps}: if values are rounded, these clusters are steps of rounding. Uniform "
     "noise of up to half a step, added to every rounded attribute, tells which "
     "clusters do not rest on it."},

    // pipeline
    {"isopoints_at_border",
     "{percent} % of the isopoints lie at the border of the samples: the surface "
     "may go on beyond it."},
    {"isopoints_beside_samples",
     "{percent} % of the isopoints lie at the border of the samples or in gaps: the "
     "surface may go on beyond it."},
    {"guessed_isopoints",
     "{percent} % of the isopoints lie between lines of samples or beside gaps: "
     "where the surface crosses a line is known, how it runs from there is a "
     "guess.{validate| A hold-out test tells how good it is ({-validate}).|}{scale| "
     "{-scale}{gaps| or {-fill-gaps}|} may help.|{gaps| {-fill-gaps} may "
     "help.|}}{bridged| {-drop-bridged} leaves out the isopoints in gaps.|}"},
    {"smoothed_guesses",
     "{percent} % of the isopoints lie between lines of samples or beside gaps: "
     "where the surface crosses a line is known, how it runs from there is a guess. "
     "The isosurface through the same samples can be tested "
     "({-validate}), and its gaps filled ({-fill-gaps})."},
    {"guessed_border",
     "{percent} % of the isopoints lie in or beside gaps between samples, and where "
     "the border of the cluster runs there is a guess."},
    {"thin_parts",
     "{percent} % of the isopoints are on parts or gaps that are thinner than two "
     "spacings: they are one layer of samples, which cannot tell the two sides "
     "apart, or noise. Areas and volumes there say little. If the file has cells, "
     "contour the cells instead; if the values are noisy, smooth them."},
    {"spikes",
     "Of the samples next to the surface {percent:2} % have values far from those "
     "of all samples around them, which agree with one another: the isopoints "
     "around each of them show an outlier and no surface. {-smooth} takes the "
     "median of the neighbours instead, and {-where} leaves out values that cannot "
     "be."},
    {"contradicted_isopoints",
     "Samples contradict {removed} of {isopoints} isopoints, which were removed: "
     "the 8 nearest samples are all on one side of the isovalue. Try: "
     "{-interpolation fit} keeps them."},
    {"few_isopoints_left",
     "Of {isopoints} isopoints {left} are left by "
     "{by_error|{-max-error}{by_support| and {-drop-bridged}|}|{-drop-bridged}}: of "
     "the rest of the surface the samples do not tell that well."},
    {"no_isopoints_left",
     "{isopoints|The last isopoint was|The last {isopoints} isopoints were} left "
     "out by {by_error|{-max-error}{by_support| and "
     "{-drop-bridged}|}|{-drop-bridged}}: the samples tell of no part of the "
     "surface that well."},
    {"surface_tells_nothing",
     "Near the surface, the class of samples that were left out is told no better "
     "by the surface than by always saying the same: it does not follow the field."},
    {"samples_tell_better",
     "Near the surface, the nearest sample tells the class of samples that were "
     "left out better than the surface does: the field changes too fast for these "
     "samples there, or their values are noisy or outliers."},
    {"lines_tell_better",
     "Near the surface, the nearest sample tells the class of samples that were "
     "left out better than the surface does: trust where it crosses lines of "
     "samples, not what lies between.{scale| {-scale}{gaps| or {-fill-gaps}|} may "
     "help.|{gaps| {-fill-gaps} may help.|}}"},
    {"small_errors",
     "Of the samples that were left out farther from the surface than its estimated "
     "error many lie on the wrong side: the errors are too small there, or the "
     "samples are noisy."},
    {"unfilled_gaps",
     "There are gaps between the samples, and none was filled: {reason}."},
    {"few_filled_gaps",
     "Few gaps were filled: at {surer} of {crossings} crossings of the surface in "
     "gaps, fits to the measured samples are surer of it than kriging is."},
    {"no_isopoints_in_gaps",
     "There are no isopoints between the samples: of {found} that were found, "
     "kriging explains nothing of the variance at {unexplained}, and {off_surface} "
     "lie off the surface that it predicts."},
    {"worse_in_gaps",
     "The surface is worse where gaps are filled: half of the errors between "
     "predicted samples are above {predicted:3}, between measured ones across a gap "
     "above {measured:3}. Leave out {-fill-gaps}."},
    {"guess_in_gaps",
     "Between the samples the surface is a guess: at half of the isopoints there, "
     "kriging explains no more than {percent} % of the variance (field confidence). "
     "A hold-out test tells how good it is ({-validate})."},
    {"equal_isovalues",
     "Isovalues that are equal in float cannot be told apart by the field isovalue: "
     "extract them one at a time."},
    {"edges_without_image",
     "{left} of {edges} edges in the faces of the box have no image in the opposite "
     "face, so that the mesh is not closed across it: the surface is tangent to the "
     "face there, or the samples are too sparse or noisy."},

    // render
    {"no_logarithms",
     "The values of '{field}' are not above 0 at {grey} of {points} points, where "
     "they have no logarithm: these points are grey."},

    // vtk
    {"short_distance",
     "The longest edge of the cluster's spanning tree is {edge}: at less than half "
     "of it the surface falls into pieces."},
    {"shared_cells",
     "The {points} points of the cluster lie in {cells} cells of the grid, and the "
     "{is_distance|surface is at a distance from these|hull goes through one of "
     "each}: a finer grid helps, or to leave out points that lie far from the "
     "others{has_outlier| (the point of index {point} lies {ratio} times as far "
     "from the middle as half of them do)|}."},

    // filters
    {"renamed_array", "The array '{array}' is called '{name}'."},
    {"unfitting_array",
     "The array '{array}' has {tuples} tuples for {points} points and is left out."},
    {"cell_data_left_out",
     "There are data of cells only, which are left out: the option cells, or the "
     "filter vtkCellCenters, makes samples of them."},
    {"array_of_texts",
     "The array '{array}' holds no numbers but is a {type} and is left out."},

    // io
    {"several_names",
     "The attribute '{attribute}' has several names per point: it holds their "
     "numbers."},
    {"file_attributes",
     "{attributes} {attributes|attribute|attributes} of the whole file "
     "{attributes|is|are} left out."},
    {"point_groups",
     "{groups} {groups|group|groups} of points {groups|is|are} left out."},
    {"mixed_units",
     "Coordinates are {x}, {y} and {z}, so distances mix {are_degrees|degrees with "
     "another unit|different units of length}. Try: {can_be_mapped|{-map auto}, "
     "which maps degrees to kilometres or metres|columns in one unit of length}, or "
     "factors for the axes ({-scale})."},
    {"common_ending",
     "The columns {x}, {y} and {z} are taken as the coordinates, because their "
     "names differ in a letter only. Try: {-xyz} if other columns are the "
     "coordinates."},
    {"unfitting_block",
     "The block '{block}' does not fit the particles and is left out."},
    {"far_positions",
     "{far} of {positions} positions {far|is|are} far from all others, for example "
     "at {longitude}, {latitude}, {distance} km from their median. Such positions "
     "are often missing fixes. Try: {-where \"{field} != {degrees:17}\"} leaves "
     "them out."},
    {"mapped_positions",
     "Positions are mapped around {longitude}, {latitude}: x and y are "
     "{in_metres|metres|kilometres} to the east and north{tells_z|, z is {z}|}."},
    {"inexact_fields_left_out",
     "{path} leaves out the {fields|field|fields} {names}: the format has no 64-bit "
     "integers, and double does not hold {fields|its|their} values exactly. Try: "
     ".vtp, .pcd or .csv to keep {fields|it|them}."},
    {"numbered_names",
     "{path} holds numbers only: the names in {fields} are counted from 0 in "
     "alphabetical order, and .csv, .ply or .vtp keep them."},
    {"numbered_names_listed",
     "{path} holds numbers only: the names in {fields} are counted from 0 in "
     "alphabetical order, and comments of the file list them."},
    {"extra_bytes",
     "{bytes} extra {bytes|byte|bytes} of every point {bytes|is|are} left out."},
    {"unnamed_columns",
     "The array names no columns: those behind x, y and z are called column_3 and "
     "so on."},
    {"array_of_others",
     "The array '{array}' has no numbers for every point and is left out."},
    {"list_property", "The list property '{property}' of the vertices is left out."},
    {"several_kinds",
     "There are {kinds} particles; the first are read, {-particles} chooses others."},
    {"comoving_units",
     "Numbers are those of the file, whose units hold factors of the redshift "
     "{redshift}{has_hubble| and of the Hubble parameter {hubble}|. The file does "
     "not give the Hubble parameter}."},
    {"repeated_column",
     "Line {line} names '{name}' again: that column is called '{column}'."},
    {"more_repeated_columns",
     "{columns} more {columns|column is|columns are} told apart in the same way."},
    {"no_header_line",
     "There is no header line: the columns are called column_0 to column_{last}."},
    {"skipped_titles",
     "{lines} {lines|line|lines} above the names of the columns {lines|was|were} "
     "skipped, from '{first}' on."},
    {"skipped_units", "Line {line} holds no number and was taken for units: {units}."},
    {"skipped_count", "Line {line} was taken for the number of rows and skipped."},
    {"decimal_commas", "Numbers have decimal commas: 0,5 is one half."},
    {"first_zone", "Of the zones of Tecplot's file the first one is read, as points."},
    {"below_detection",
     "{cells} values of '{column}' are given as below a limit, as <0.25: the limit is "
     "taken, and '{flag}' is 1 there. Try: {column}*(1-0.5*{flag}) takes half of it."},
    {"guessed_coordinates",
     "The header names no x, y, z: the first three columns{skips_times| that are no "
     "times|} ({x}, {y}, {z}) are the coordinates."},
    {"kept_as_names",
     "The column '{column}' is kept as names, since '{cell}' in line {line} is no "
     "number."},
    {"too_many_names",
     "The column '{column}' holds more than {most} different names, and is left out."},
    {"rounded_integers",
     "The column '{column}' holds integers beyond 2^53, which lose digits."},

    // io_vtk
    {"wide_table",
     "The table '{table}' has {components} numbers per point and is left out."},
    {"several_groups",
     "Points are read from '{group}'; {others} other {others|group holds|groups hold} "
     "points too, as in "
     "file.h5:{other}."},
    {"vertical_axis", "z is {z}."},
    {"dead_particles",
     "{dead} dead {dead|particle|particles} (h <= 0) {dead|is|are} left out."},
    {"field_of_some_parts",
     "The field '{field}' is left out: not all of the parts have it."},
    {"last_time", "Of {times} times the last one is read, {last}."},
    {"first_listed_time",
     "Of the times that '{list}' lists the first one, {time}, is read."},
    {"repeated_files",
     "The list '{list}' names files again {times} {times|time|times}: each of them is "
     "read once."},
    {"array_without_numbers", "The array '{array}' holds no numbers and is left out."},
    {"wide_array",
     "The array '{array}' has {components} numbers per point and is left out."},
    {"only_cell_data",
     "There are data of cells only, which are left out: ParaView's filter Cell "
     "Centers makes samples of them."},
    {"first_time", "Of its {times} times the first one is read."},
    {"unfitting_layers",
     "The array '{array}' has {layers} layers of {numbers} numbers for {needed} of "
     "{points} points and is left out."},

    // tools
    {"box_in_file",
     "The file names a box of {sides}: if it repeats, {-periodic header} sees "
     "neighbours across its faces."},
    {"white_on_white",
     "The surface is white, as is the background: {-no-shading} leaves its lines, "
     "by {-silhouettes} and {-features}, or colours, by {-color}."},
    {"no_masses",
     "There is no field of masses: sph_density counts particles per volume."},
    {"only_one_mapped",
     "The positions of '{path}' are mapped and those of '{other}' are not: their "
     "coordinates are not in one system. Try: {-map auto} maps both, {-map lon,lat} "
     "around a given origin."},
    {"no_longitudes",
     "'{path}' has no columns or fields of longitude and latitude in degrees: "
     "{-map} leaves its coordinates as they are."},
    {"not_on_map",
     "'{path}' has no longitudes and latitudes: its coordinates are taken for metres "
     "east and north of the middle of the map of '{other}'. If they are degrees, call "
     "their columns longitude and latitude."},
    {"graphics_card_failed",
     "The graphics card could not draw it, the CPU did: {reason}"},
    {"repeated_colors",
     "The points have more than {most} names in '{field}': their colours repeat, "
     "and the picture has no legend."},
    {"no_points_in_file", "{path} has no points."},
    {"no_finite_points", "{path} has no point with finite x, y, z."},
    {"no_coordinate_columns",
     "{path} names no columns of coordinates: {-xyz} chooses them."},
    {"fits_swing",
     "Fits swing where the field steps to the value outside: pieces beside the "
     "surface may be theirs, and {-interpolation linear}, for points, has none."},
    {"nothing_to_draw", "There is nothing to draw: {path} was not written."},
    {"stl_without_origin",
     "STL holds single precision, which these coordinates exceed: those in the file "
     "are relative to {origin}."},
    {"gaussians_without_origin",
     "Gaussians have coordinates in float: they start at an origin, {origin}, which "
     "is not in the file."},
    {"oriented_to_zero",
     "The file has no normals to orient by: the new ones look to 0,0,0; "
     "{-viewpoint} chooses another place."},
    {"cells_not_used",
     "The cells of the input are not used: {reason} The samples decide where the "
     "data are."},
    {"grey_places",
     "The picture is grey at {hidden} of {places} places, where values of '{field}' "
     "are not above 0 and have no logarithm."},
    {"unconstrained_measures",
     "Most of the surface lies between lines of samples or beside gaps: its area, "
     "its volume and what is inside are not constrained by the samples. Try: "
     "{-block dx,dy,dz} estimates volumes and means beyond a value without a "
     "surface."},
    {"no_triangles",
     "{surface} has no triangles: distances to it are those to its points, and no "
     "smaller than these lie apart."},
    {"many_common_fields",
     "The surfaces have {fields} fields in common: {told} of them are told."},
};

} // namespace

MessageTexts
listWarnings()
{
  return {std::begin(warning_rows), std::end(warning_rows)};
}

} // namespace pcl_uvol::detail
