// SPDX-License-Identifier: BSD-3-Clause
#include "common/message_texts.h"

#include <iterator>

namespace pcl_uvol::detail {

namespace {

const MessageText warning_rows[] = {
    // common
    {"repeated_field",
     "The field name '{field}' is repeated. This field is renamed to '{name}'."},
    {"more_repeated_fields",
     "{fields} more repeated {fields|field is|fields are} renamed in the same way."},
    {"points_beyond_float",
     "{points} {points|point has|points have} a coordinate of 3.4e38 or more, too "
     "large for float. {points|It counts|They count} as missing."},
    {"rounded_coordinates",
     "Float rounding moves coordinates by up to {rounding:2}, {spacings:2} times the "
     "distance between neighbours (about {spacing:2}). Neighbours may coincide. Try: "
     "separate files for distant parts."},
    {"rounded_far_points",
     "Float rounding moves single distant points by up to {rounding:2}, {spacings:2} "
     "times the distance between neighbours (about {spacing:2})."},
    {"merged_positions",
     "{positions} {positions|position coincides|positions coincide} with others after "
     "rounding to float (up to {distance:2} apart). They count as duplicates. Try: "
     "separate files for distant parts."},
    {"conflicting_samples",
     "{percent} % of the sample positions have several different values. Their median "
     "is used. Try: {-where} to select one, for example {-where \"experiment=1\"}."},

    // neighbors
    {"far_points",
     "{far_points} {far_points|outlier is|outliers are} ignored, 1e12 times farther "
     "out than "
     "most points. {far_points|It|The first} is point {first} at ({x:6}, {y:6}, "
     "{z:6})."},
    {"unfilled_box",
     "The samples fill {length} of the side {side} of the box along {axis}. If they "
     "should fill the box, the side is wrong. Try: other sides ({-periodic})."},
    {"samples_beyond_box",
     "Samples extend over {length} along {axis}, but the box side is {side}. They are "
     "wrapped into the box. Unless the samples are unwrapped, the side is wrong."},

    // interpolation
    {"overshoots",
     "{exceeding} of the {values} values of {field} exceed the data range by more than "
     "its "
     "width. The model overshoots. Try: {-model natural}, which stays within the "
     "range."},
    {"invalid_queries",
     "{invalid} of the {queries} query positions are not finite and have no value."},
    {"queries_outside",
     "{outside} of the {queries} query positions are outside the data: "
     "{has_values|their values are extrapolated.|they have no value (NaN). Try: "
     "{-extrapolate}.}"},
    {"weak_support",
     "{weak} of the {queries} query positions are in gaps, at the border, or near "
     "samples that do not determine the model. Their values are poorly constrained."},
    {"uncertain_values",
     "{uncertain} of the {values} values of {field} have a standard error above the "
     "spread of the samples. The model is unreliable there. Try: {-validate} to "
     "compare models."},
    {"total_sill",
     "The partial sill of {field}, {psill}, is near the variance of the samples, "
     "{variance}. It may be the total sill. Try: {rest}, without the nugget {nugget}."},
    {"no_variogram",
     "The field {field} is constant, so it has no variogram. Every estimate is that "
     "constant, with error 0."},
    {"nothing_covered",
     "None of the {tested} held-out samples has a value: each fold is outside the "
     "other samples. No error was measured. Try: {-extrapolate}, more folds, or "
     "{-validate-by blocks}."},
    {"few_samples_for_choice",
     "There are too few samples to choose a model. Local fits are used."},

    // expressions
    {"undefined_field",
     "The field '{field}' is undefined at {undefined} of {points} points, for example "
     "through division by zero or the logarithm of a negative number. They have no "
     "value."},
    {"unknown_derivatives",
     "The derivatives are unknown at {unknown} of {points} points: their standard "
     "error exceeds the differences between values. These points have no value. Try: "
     "smooth the field first."},
    {"reduced_derivatives",
     "The neighbours of {samples} {samples|sample|samples} are in few planes or lines. "
     "Derivatives across them are set to 0."},

    // isosurface
    {"no_isopoints",
     "No isopoints for {isovalue}: it is outside the range [{low}, {high}] of "
     "{field}."},
    {"constant_field", "No isopoints for {isovalue}: all values of {field} are {low}."},
    {"lowest_isovalue",
     "No isopoints for {isovalue}: it is the minimum of {field}, and values equal to "
     "the isovalue count as above. Try: a larger isovalue."},
    {"replaced_field",
     "The field '{field}' of the samples is not copied, because isopoints have a field "
     "of that name."},

    // mesh
    {"large_caps",
     "{percent} % of the mesh area at {isovalue} is caps at the border of the samples. "
     "If values outside are {is_lower_outside|higher|lower}, try: "
     "{is_lower_outside|{-outside higher}|{-outside lower}}."},
    {"folds",
     "{folds} of {triangles} triangles are inverted{is_even| and {slivers} have angles "
     "below 5 degrees|}. Samples there are sparse, noisy or stretched. Try: "
     "{-fill-gaps} (lines), {-smooth} (noise), or isopoints."},
    {"open_pieces",
     "{open} of {pieces} pieces are open, or their outside contradicts other pieces. "
     "They enclose no volume, and only their area is measured."},
    {"uncertain_measures",
     "The area or volume of {uncertain} of {surfaces} surfaces is uncertain by more "
     "than a "
     "third, because the errors of the vertices are large."},
    {"missed_samples",
     "The surface at {isovalue} encloses {enclosed} samples; {beyond} are beyond the "
     "isovalue. {encloses_more|It is unconstrained between samples.|It misses small "
     "clumps.} Try: sums beyond the isovalue (masses)."},
    {"kept_uncertain_pieces",
     "All pieces of some isovalues ({kept} of {pieces}) have an error as large as the "
     "piece. They are kept, because no others exist. Try: other isovalues."},
    {"uncertain_pieces",
     "{uncertain} of {pieces} pieces (area {area} +- {error}) have errors as large as "
     "themselves: few samples surround them, or debris. {are_left_out|They are "
     "excluded.|Try: {-drop-uncertain} to exclude them.}"},
    {"flat_surfaces",
     "{flat} of {surfaces} surfaces are flat: they have no volume and enclose no "
     "samples. If all samples are in one plane, the isosurface is a curve."},
    {"negative_volumes",
     "The normals point to the enclosed side, so volumes are negative."},
    {"area_in_gaps",
     "{percent} % of the area is in gaps or at the border of the samples, as in thin "
     "shells, and not constrained. Try: contour the cells, if any."},
    {"points_without_area",
     "{percent} % of the points do not contribute to the area: they have no normal, "
     "are duplicates, or have too few neighbours."},
    {"contrary_normals",
     "{percent} % of the points have neighbours with opposite normals. Unless sheets "
     "are closer than the point spacing, areas count twice. Try: orient the normals."},
    {"self_intersections",
     "The surface intersects itself in {pairs} {pairs|pair|pairs} of triangles, the "
     "first at {x:6},{y:6},{z:6}."},
    {"area_without_error",
     "{percent} % of the area has vertices without an estimated error. The errors of "
     "the measures ignore this area."},

    // levelset
    {"vanished",
     "The level set of {field} at {isovalue} vanished. {starts_from_values|Smoothing "
     "removed it. Try: a larger {-mu}.|Inside and outside may be swapped. Try: "
     "{-outside}, or no custom start.}"},
    {"tied_values",
     "{percent:2} % of the values next to the isovalue {isovalue} are identical "
     "(rounded or clipped). The noise is unknown, and nothing was smoothed. Try: {-mu "
     "0.1}."},
    {"not_converged",
     "The level set at {isovalue} has not converged by step {steps}: it moves "
     "{change:2} spacings per unit time.{is_last_stage|| Mu ended at {mu:2}, not "
     "{chosen_mu:2}.}"},
    {"lost_features",
     "Smoothing removed features: {lost} {lost|sample is|samples are} now across the "
     "surface, farther from the isovalue {isovalue} than noise explains. Try: {-mu} "
     "above {mu:2}."},
    {"outliers",
     "{percent:2} % of the samples next to the surface ({outliers}) are outliers: "
     "their values differ from all neighbours. The level set uses the median of the "
     "neighbours."},

    // surface
    {"estimated_normals",
     "The cloud has no normals. They were estimated, and the surface is drawn from "
     "both sides."},
    {"bad_splats",
     "{bad} of {splats} splats are ignored: they are not finite, have no normal, "
     "tangent or radius, or exceed {reach:6} in size or distance."},
    {"ready_splats",
     "The points are splats already and are drawn unchanged. The parameters delta and "
     "lambda are not used."},

    // multivariate
    {"constant_attribute", "The attribute {attribute} is constant and is ignored."},
    {"few_clusters",
     "There {clusters|is|are} {clusters} {clusters|cluster|clusters}: too few to "
     "separate. The projection uses the principal axes."},
    {"no_clusters",
     "Among {points} points, no cluster of at least {min_size} differs from the others "
     "by more than chance. Try: a smaller minimum size, or allow a single cluster."},
    {"no_clusters_at_distance",
     "Among {points} points, no cluster of at least {min_size} is connected at the "
     "distance {distance}. Try: a larger distance, or a smaller minimum size."},
    {"mostly_noise",
     "{noise} of {points} points belong to no cluster. The clusters describe little of "
     "the data."},
    {"clusters_of_rounding",
     "{steps}: if values are rounded, these clusters are artefacts. Try: cluster again "
     "with uniform noise of up to half a step added to rounded attributes."},

    // pipeline
    {"isopoints_at_border",
     "{percent} % of the isopoints are at the border of the samples. The surface may "
     "continue beyond it. Try: samples farther out, if available."},
    {"isopoints_beside_samples",
     "{percent} % of the isopoints are at the border of the samples or in gaps. The "
     "surface may continue there. Try: samples farther out, if available."},
    {"unconstrained_isopoints",
     "{percent} % of isopoints are between sample lines or next to gaps. Only "
     "crossings with lines are reliable. Try: {validate|{-validate}, "
     "|}{scale|{-scale}, |}{gaps|{-fill-gaps}, |}{bridged|{-drop-bridged}, |}more "
     "samples."},
    {"unconstrained_level_set",
     "{percent} % of the isopoints are between lines of samples or next to gaps. The "
     "surface is not constrained there. Try: {-validate} and {-fill-gaps} with the "
     "unsmoothed isosurface."},
    {"unconstrained_border",
     "{percent} % of the isopoints are in or next to gaps between samples. The cluster "
     "border is not constrained there. Try: a surface at a distance from the points."},
    {"thin_parts",
     "{percent} % of the isopoints are on parts or gaps thinner than two spacings "
     "(single sample layers, or noise). Areas and volumes are unreliable. Try: contour "
     "cells, or {-smooth}."},
    {"spikes",
     "{percent:2} % of the samples next to the surface are outliers with consistent "
     "neighbours. The isopoints around them are artefacts. Try: {-smooth}, or {-where} "
     "to exclude the outliers."},
    {"contradicted_isopoints",
     "{removed} of {isopoints} isopoints were removed: their 8 nearest samples are on "
     "one side of the isovalue. Try: {-interpolation fit} to keep them."},
    {"unlocated_isopoints",
     "{removed} of {isopoints} isopoints were removed: in gaps, their errors exceed "
     "the distance to better ones. Try: {gaps|{-fill-gaps}, or |}{-interpolation fit} "
     "to keep them."},
    {"few_isopoints_left",
     "Only {left} of {isopoints} isopoints remain after "
     "{by_error|{-max-error}{by_support| and {-drop-bridged}|}|{-drop-bridged}}. The "
     "samples determine the rest less precisely.{by_error| Try: a larger "
     "{-max-error}.|}"},
    {"no_isopoints_left",
     "{by_error|{-max-error}{by_support| and {-drop-bridged}|}|{-drop-bridged}} "
     "removed the last {isopoints|isopoint|{isopoints} isopoints}. No part of the "
     "surface is certain enough.{by_error| Try: a larger {-max-error}.|}"},
    {"worse_than_baseline",
     "Near the surface, the surface classifies {surface} % of {samples} held-out "
     "samples correctly, the majority class {baseline} %. Do not use it between the "
     "samples."},
    {"worse_than_nearest_sample",
     "The surface classifies {surface} % of {samples} held-out samples near it "
     "correctly (nearest sample {nearest} %). Values change fast or are noisy. Try: "
     "{-smooth}, or {-where}."},
    {"worse_than_nearest_on_lines",
     "The surface classifies {surface} % of {samples} held-out samples near it "
     "correctly (nearest sample {nearest} %). Use only crossings with "
     "lines.{scale| Try: {-scale}{gaps| or {-fill-gaps}|}.|{gaps| Try: "
     "{-fill-gaps}.|}}"},
    {"small_errors",
     "Of {samples} held-out samples beyond the estimated error, {percent} % are on the "
     "wrong side. Errors are too small, or samples noisy. Do not filter by error."},
    {"unfilled_gaps",
     "There are gaps between the samples, but none was filled: {reason}."},
    {"few_filled_gaps",
     "Few gaps were filled: at {by_fits} of {crossings} crossings of the surface in "
     "gaps, local fits have smaller standard errors than kriging. No action is "
     "needed."},
    {"no_isopoints_in_gaps",
     "No isopoints are left in the gaps. Of {found}, kriging explains no variance at "
     "{unexplained}, and {off_surface} are off the predicted surface. Try: another "
     "{-scale}."},
    {"worse_in_gaps",
     "Filled gaps make the surface worse: the median error is {predicted:3} between "
     "predicted samples, but {measured:3} between measured samples across gaps. Try: "
     "no {-fill-gaps}."},
    {"unconstrained_gaps",
     "The surface in gaps is unreliable: at half of its isopoints, kriging explains at "
     "most {percent} % of the variance (field confidence). Check it with {-validate}."},
    {"equal_isovalues",
     "Some isovalues are equal in float, so the field isovalue cannot distinguish "
     "them. Try: extract them one at a time."},
    {"edges_without_image",
     "{left} of {edges} edges in box faces have no image in the opposite face. The "
     "mesh is open there: the surface is tangent, or samples sparse or noisy."},

    // render
    {"no_logarithms",
     "The values of '{field}' are not positive at {grey} of {points} points and have "
     "no logarithm. These points are grey."},

    // vtk
    {"short_distance",
     "The distance is less than half of the cluster's longest spanning-tree edge, "
     "{edge}. The surface breaks into pieces. Try: a larger distance."},
    {"shared_cells",
     "The {points} points share {cells} grid cells, so the surface is coarse. Try: a "
     "finer grid, or exclude outliers{has_outlier| (point {point}: {ratio} times the "
     "median distance)|}."},

    // filters
    {"renamed_array", "The array '{array}' is renamed to '{name}'."},
    {"unfitting_array",
     "The array '{array}' is ignored: it has {tuples} tuples for {points} points."},
    {"cell_data_left_out",
     "The input has cell data only, which are ignored. Try: {-cells}, or the filter "
     "vtkCellCenters, to use cells as samples."},
    {"array_of_texts",
     "The array '{array}' is ignored: it is a {type} without numbers."},

    // io
    {"several_names",
     "The attribute '{attribute}' has several names per point. It is stored as the "
     "numbers of the names."},
    {"file_attributes",
     "{attributes} {attributes|attribute|attributes} of the whole file "
     "{attributes|is|are} ignored."},
    {"point_groups",
     "{groups} {groups|group|groups} of points {groups|is|are} ignored."},
    {"mixed_units",
     "Coordinates are {x}, {y} and {z}: distances mix {are_degrees|degrees with "
     "another unit|units of length}. Try: {can_be_mapped|{-map auto} for "
     "degrees|columns in one unit}, or {-scale}."},
    {"common_ending",
     "The columns {x}, {y} and {z} are used as coordinates, because their names differ "
     "in one letter only. Try: {-xyz} to choose other columns."},
    {"unfitting_block",
     "The block '{block}' is ignored, because it does not fit the particles."},
    {"far_positions",
     "{far} of {positions} positions {far|is|are} far away, for example {longitude}, "
     "{latitude}, {distance} km from the median. Try: {-where \"{field} != "
     "{degrees:17}\"} to exclude missing fixes."},
    {"mapped_positions",
     "Positions are mapped around {longitude}, {latitude}: x and y are "
     "{in_metres|metres|kilometres} to the east and north{gives_z|, z is {z}|}."},
    {"inexact_fields_left_out",
     "{path} omits the {fields|field|fields} {names}: the format has no 64-bit "
     "integers, and double cannot represent {fields|its|their} values. Try: .vtp, .pcd "
     "or .csv."},
    {"numbered_names",
     "{path} stores numbers only: the names in {fields} are zero-based indices in "
     "alphabetical order. Try: .csv, .ply or .vtp to keep the names."},
    {"numbered_names_listed",
     "{path} stores numbers only: the names in {fields} are zero-based indices in "
     "alphabetical order. Comments in the file list the names."},
    {"extra_bytes",
     "{bytes} extra {bytes|byte|bytes} of every point {bytes|is|are} ignored."},
    {"unnamed_columns",
     "The array does not name its columns. The columns after x, y and z are called "
     "column_3, column_4 and so on."},
    {"array_of_others",
     "The array '{array}' is ignored: it does not have numbers for every point."},
    {"list_property", "The list property '{property}' of the vertices is ignored."},
    {"several_kinds",
     "The file has several kinds of particles: {kinds}. The first kind is read. Try: "
     "{-particles} to choose another kind."},
    {"comoving_units",
     "Values are in the units of the file, with factors of the redshift "
     "{redshift}{has_hubble| and the Hubble parameter {hubble}|. The file does not "
     "give the Hubble parameter}."},
    {"repeated_column",
     "Line {line} repeats the name '{name}'. That column is renamed to '{column}'."},
    {"more_repeated_columns",
     "{columns} more repeated {columns|column is|columns are} renamed in the same "
     "way."},
    {"no_header_line",
     "The file has no header line. The columns are called column_0 to column_{last}."},
    {"skipped_titles",
     "{lines} {lines|line|lines} above the column names {lines|is|are} skipped, "
     "starting with '{first}'."},
    {"skipped_units", "Line {line} has no numbers and is read as units: {units}."},
    {"skipped_count", "Line {line} is read as the number of rows and skipped."},
    {"decimal_commas", "Numbers have decimal commas: 0,5 is read as one half."},
    {"first_zone", "Of the Tecplot zones, the first one is read, as points."},
    {"below_detection",
     "{cells} values of '{column}' are below detection limits, for example <0.25. The "
     "limit is used, and '{flag}' is 1 there. Try: {column}*(1-0.5*{flag}) for half "
     "the limit."},
    {"assumed_coordinates",
     "The header does not name x, y and z. The first three columns{skips_times| that "
     "are not times|} ({x}, {y}, {z}) are used. Try: {-xyz} to choose others."},
    {"kept_as_names",
     "The column '{column}' is read as names, because '{cell}' in line {line} is not a "
     "number. Try: correct the cell or leave it empty."},
    {"too_many_names",
     "The column '{column}' is ignored: it has more than {most} different names."},
    {"rounded_integers",
     "The column '{column}' has integers beyond 2^53, which lose digits."},

    // io_vtk
    {"wide_table",
     "The table '{table}' is ignored: it has {components} numbers per point."},
    {"several_groups",
     "Points are read from '{group}'. {others} other {others|group has|groups have} "
     "points too. Try: file.h5:{other} to read another group."},
    {"vertical_axis", "z is {z}."},
    {"dead_particles",
     "{dead} dead {dead|particle|particles} (h <= 0) {dead|is|are} ignored."},
    {"field_of_some_parts",
     "The field '{field}' is ignored: some parts do not have it."},
    {"last_time", "Of {times} times, the last one is read: {last}."},
    {"first_listed_time", "Of the times in '{list}', the first one is read: {time}."},
    {"repeated_files",
     "The list '{list}' repeats files {times} {times|time|times}. Each file is read "
     "once."},
    {"array_without_numbers", "The array '{array}' is ignored: it has no numbers."},
    {"wide_array",
     "The array '{array}' is ignored: it has {components} numbers per point."},
    {"only_cell_data",
     "The file has cell data only, which are ignored. Try: ParaView's filter Cell "
     "Centers to use cells as samples."},
    {"first_time", "Of {times} times, the first one is read."},
    {"unfitting_layers",
     "The array '{array}' is ignored: it has {layers} layers of {numbers} numbers for "
     "{needed} layers of {points} points."},

    // tools
    {"box_in_file",
     "The file names a box with the sides {sides}. Try: {-periodic header} if the box "
     "is periodic."},
    {"white_on_white",
     "The surface and the background are both white. Try: {-color}, or {-no-shading} "
     "with {-silhouettes} and {-features}."},
    {"no_masses",
     "There is no mass field. The field sph_density counts particles per volume."},
    {"only_one_mapped",
     "The positions of '{path}' are mapped, but not those of '{other}'. Their "
     "coordinate systems differ. Try: {-map auto} for both, or {-map lon,lat} with an "
     "origin."},
    {"no_longitudes",
     "'{path}' has no columns or fields of longitude and latitude in degrees. {-map} "
     "does not change its coordinates. Try: {-xyz} to name the columns."},
    {"not_on_map",
     "'{path}' has no longitudes. Its coordinates are used as metres east and north of "
     "the map centre of '{other}'. Try: name columns in degrees longitude and "
     "latitude."},
    {"graphics_card_failed",
     "The graphics card failed, and the image was drawn on the CPU: {reason}"},
    {"repeated_colors",
     "The field '{field}' has more than {most} names. Their colours repeat, and the "
     "image has no legend."},
    {"no_points_in_file", "{path} has no points."},
    {"no_finite_points", "{path} has no point with finite x, y, z."},
    {"no_coordinate_columns",
     "{path} does not name coordinate columns. Try: {-xyz} to choose them."},
    {"fits_oscillate",
     "The fits oscillate at the jump to {-outside-value} and may create spurious "
     "pieces. Try: {-interpolation linear}, for points."},
    {"nothing_to_draw", "There is nothing to draw. {path} was not written."},
    {"stl_without_origin",
     "STL has single precision, too coarse for these coordinates. The coordinates in "
     "the file are relative to {origin}."},
    {"gaussians_without_origin",
     "Gaussians have float coordinates, here relative to the origin {origin}. The file "
     "does not contain the origin."},
    {"oriented_to_zero",
     "The file has no normals to orient by. The new normals point towards 0,0,0. Try: "
     "{-viewpoint} to choose another point."},
    {"cells_not_used",
     "The cells of the input are not used: {reason} The samples determine where the "
     "data are. Try: repair the cells."},
    {"grey_places",
     "The image is grey at {hidden} of {places} points: values of '{field}' are not "
     "positive there and have no logarithm."},
    {"unconstrained_measures",
     "{percent} % of the surface is between lines of samples or next to gaps. Its "
     "measures are not constrained. Try: {-block dx,dy,dz} for volumes, or contour "
     "cells."},
    {"no_triangles",
     "{surface} has no triangles. Distances to its points are used, which are limited "
     "by the point spacing."},
    {"many_common_fields",
     "The surfaces have {fields} fields in common. {listed} of them are reported."},
};

} // namespace

MessageTexts
listWarnings()
{
  return {std::begin(warning_rows), std::end(warning_rows)};
}

} // namespace pcl_uvol::detail
