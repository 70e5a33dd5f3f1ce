# A scene as Windows' editor saves it when it is told "Unicode".
printf '\377\376s\0e\0t\0\n\0' > input.prm
debond input.prm
