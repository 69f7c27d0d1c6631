# Charts of estimators.md from its CSV:  gnuplot docs/results/estimators.gp  (from the repository root)
set terminal svg size 900,520 font "sans,13" background "white"
set datafile separator ","
data = "docs/results/estimators/"
pictures = "docs/pictures/estimators-"
set grid lc rgb "#dddddd"
set key outside right top

set output pictures."n.svg"
set title "U_{ri} in the layer of 0.1 mean free path under the surface"
set logscale xy
set xlabel "photons emitted"; set ylabel "relative L2 error"
set yrange [0.003:0.7]
row(file, c, s) = sprintf("< awk -F, '$1==\"%s\" && $2==\"%s\"' %s", c, s, data.file)
plot for [c in "slab_oblique sphere sphere_20 torus"] row("n.csv", c, "random") \
       using 3:7 with linespoints dt 2 title c.", random" noenhanced, \
     for [c in "slab_oblique sphere sphere_20 torus"] row("n.csv", c, "low_discrepancy") \
       using 3:7 with linespoints lw 2 title c.", low discrepancy" noenhanced, \
     0.01 with lines lc rgb "black" dt 3 title "1 %"

setting(c, s, e) = sprintf("< awk -F, '$1==\"%s\" && $2==\"%s\" && $3==\"%s\"' %s", c, s, e, \
                           data."settings.csv")
set output pictures."settings.svg"
set title "sphere, 1 M photons, same layer: bias (lines) and noise (dashed) over the count"
set xlabel "photons in the ball"; set yrange [0.001:1]
set key outside right top
plot for [e in "carried slope nearest kernel"] setting("sphere", "low_discrepancy", e) \
       using 4:6 with linespoints lw 2 title e.", bias", \
     for [e in "carried slope nearest kernel"] setting("sphere", "low_discrepancy", e) \
       using 4:7 with linespoints dt 2 title e.", noise"

set output pictures."depth.svg"
unset logscale x
set title "1 M photons: U_{ri} over depth"
set xlabel "depth under the surface, mean free paths"; set ylabel "relative L2 error"
set yrange [0.004:0.5]
at(c) = sprintf("< awk -F, '$1==\"%s\"' %s", c, data."depth.csv")
plot for [c in "slab_oblique sphere torus"] at(c) using 2:3 with linespoints dt 3 \
       title c.", before" noenhanced, \
     for [c in "slab_oblique sphere torus"] at(c) using 2:4 with linespoints dt 2 \
       title c.", random" noenhanced, \
     for [c in "slab_oblique sphere torus"] at(c) using 2:5 with linespoints lw 2 \
       title c.", low discrepancy" noenhanced

set output pictures."divergence.svg"
set logscale x
set title "f in the obliquely lit slab, 1 M photons: divergence known or differentiated"
set xlabel "step of the difference, mean free paths"
set yrange [0.003:1]
most = system("awk -F, '$2+0 > m+0 {m = $2} END {print m}' ".data."divergence.csv")
of(s, d) = sprintf("< awk -F, '$1==\"%s\" && $2==%s && $3==\"%s\"' %s", s, most, d, \
                   data."divergence.csv")
plot for [s in "random low_discrepancy"] for [d in "inside surface"] of(s, d) using 4:6 \
       with linespoints title "differentiated, ".s.", ".d noenhanced, \
     for [s in "random low_discrepancy"] for [d in "inside surface"] of(s, d) using 4:5 \
       with lines dt 2 title "identity, ".s.", ".d noenhanced
