# Options that do not exist, and numbers that these do not take.
debond --loud scene.prm
debond --jobs 0 scene.prm
debond --threads 2.5 scene.prm
debond --jobs
debond scene.prm --set
