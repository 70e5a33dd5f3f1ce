# Lines that end as on Windows and on old Macs, and the mark that editors begin a file with: no mistakes.
printf '\357\273\277set Title = a\r\nsubsection Chuck\r\n  subsection Rotation z\r\n    set Value = t\r\n  end\r\nend\r\n' > input_1.prm
printf 'set Title = a\rsubsection Chuck\r  subsection Rotation z\r    set Value = t\r  end\rend\r' > input_2.prm
debond --check input_1.prm
debond --check input_2.prm
# mistakes are in the right line
printf 'set Title = a\r\nset Titel = a\r\n' > input_3.prm
printf 'set Title = a\rset Titel = a\r' > input_4.prm
debond input_3.prm
debond input_4.prm
