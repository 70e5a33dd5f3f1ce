# What the pictures of the paper's figures have in common. Included by the others.
set terminal pngcairo size 1000,700 enhanced font "Sans,15" linewidth 1.5
set encoding utf8
set datafile separator comma
set datafile columnheaders
set datafile missing "nan"
set grid linetype 1 linecolor rgb "#dddddd" linewidth 0.7
set border linecolor rgb "#555555"
set key noenhanced
