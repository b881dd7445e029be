# Kriging beside gstat: values and standard deviations of the same model at the same places, and
# drill holes of which one after the other is left out.
# usage: Rscript tests/benchmarks/kriging_gstat.R BIN_FOLDER [babbitt_drillholes.csv]
# needs: r-cran-gstat
suppressPackageStartupMessages({library(sp); library(gstat)})
arguments <- commandArgs(trailingOnly = TRUE)
probe <- file.path(arguments[1], "uvol_probe")
folder <- tempfile("kriging"); dir.create(folder)
file <- function(name) file.path(folder, name)
write <- function(table, name) write.csv(table, file(name), row.names = FALSE, quote = FALSE)
neighbors <- 32

# Numbers that single precision holds: positions are float in pcl::PointCloud.
set.seed(1)
exact <- function(x) round(x * 4096) / 4096
draw <- function(n) data.frame(x = exact(runif(n)), y = exact(runif(n)), z = exact(runif(n)))
samples <- unique(draw(2000))
samples$f <- exact(with(samples, sin(6 * x) + cos(5 * y) * z + rnorm(nrow(samples), 0, 0.1)))
queries <- draw(500)
write(samples, "samples.csv"); write(queries, "queries.csv")
points <- samples; coordinates(points) <- ~ x + y + z
places <- queries; coordinates(places) <- ~ x + y + z

compare <- function(kind, short, nugget, sill, range, trend) {
  command <- sprintf("%s %s %s -points %s -field f -model kriging -variogram %s,%g,%g,%g -trend %d -k %d -extrapolate > %s",
                     probe, file("samples.csv"), file("ours.csv"), file("queries.csv"), kind, nugget, sill, range, trend,
                     neighbors, file("log"))
  stopifnot(system(command) == 0)
  ours <- read.csv(file("ours.csv"))
  formula <- if (trend == 0) f ~ 1 else f ~ x + y + z
  theirs <- krige(formula, points, places, vgm(sill, short, range, nugget), nmax = neighbors, debug.level = 0)
  cat(sprintf("| %s, trend %d | %.1e | %.1e |\n", kind, trend, max(abs(ours$f - theirs$var1.pred)),
              max(abs(ours$f_error / sqrt(theirs$var1.var) - 1))))
}
cat("| model | largest difference of values | of standard deviations, relative |\n|---|---|---|\n")
for (trend in 0:1) {
  compare("spherical", "Sph", 0.01, 0.8, 0.7, trend)
  compare("exponential", "Exp", 0.02, 1, 0.5, trend)
  compare("gaussian", "Gau", 0.05, 0.7, 0.4, trend)
}

# Ours leaves out a tenth of the holes at a time, gstat one hole: it has a little more to go by.
if (length(arguments) > 1) {
  log <- system(sprintf("%s %s -field cu_pct -model kriging -validate 10 -validate-by hole -extrapolate", probe, arguments[2]),
                intern = TRUE)
  cat(grep("^validation", log, value = TRUE), "\n")
  holes <- read.csv(arguments[2])
  holes <- holes[is.finite(holes$cu_pct), ]
  holes <- data.frame(x = holes$x_ft - mean(holes$x_ft), y = holes$y_ft - mean(holes$y_ft), z = holes$z_ft,
                      cu = holes$cu_pct, hole = holes$hole)
  holes <- holes[!duplicated(holes[, 1:3]), ]
  coordinates(holes) <- ~ x + y + z
  for (cutoff in c(500, 2000)) {
    model <- suppressWarnings(fit.variogram(variogram(cu ~ 1, holes, cutoff = cutoff, width = cutoff / 20),
                                            vgm(0.15, "Sph", cutoff / 2, 0.05)))
    error <- score <- numeric(0)
    for (hole in unique(holes$hole)) {
      out <- holes$hole == hole
      theirs <- krige(cu ~ 1, holes[!out, ], holes[out, ], model, nmax = neighbors, debug.level = 0)
      difference <- holes$cu[out] - theirs$var1.pred
      error <- c(error, difference)
      score <- c(score, difference / sqrt(theirs$var1.var))
    }
    cat(sprintf("gstat, variogram up to %g ft: RMS %.4f, bias %.4f, %.0f %% within their standard error\n", cutoff,
                sqrt(mean(error^2)), mean(error), 100 * mean(abs(score) < 1)))
  }
}
