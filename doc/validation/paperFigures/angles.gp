# angles.png from angles.csv:  gnuplot angles.gp
set terminal pngcairo size 900,620 font 'Sans,15'
set output 'angles.png'
set datafile separator ','
set grid lc rgb '#dddddd'
set key top left
set border 3
set tics nomirror out
set xlabel 'prescribed angle [degrees]'
set ylabel 'measured angle [degrees]'
set xrange [0:185]
set yrange [0:185]
set xtics 30
set ytics 30
plot x with lines lc rgb '#888888' dt 2 title 'equal', \
    'angles.csv' skip 1 using 1:5 with points pt 9 ps 1.4 lc 4 title 'Akinci2013', \
    '' skip 1 using 1:4 with points pt 5 ps 1.2 lc 2 title 'Fujisawa2014', \
    '' skip 1 using 1:3 with points pt 6 ps 1.9 lw 2 lc 1 title 'continuumSurfaceForce, CPU', \
    '' skip 1 using 1:2 with points pt 7 ps 1.1 lc 3 title 'continuumSurfaceForce, H200', \
    '' skip 1 using 1:6 with points pt 2 ps 1.6 lw 2 lc 7 title 'default, CPU'
