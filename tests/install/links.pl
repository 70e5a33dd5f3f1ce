#!/usr/bin/perl
# links.pl DIRECTORY: follows the relative links of all pages and notebooks in an installed directory of documentation,
# and prints those that lead nowhere. Sources, tests and Containerfile are not installed.
use strict;
use warnings;
use File::Basename;
use File::Find;

my ($directory) = @ARGV;
my $not_installed = qr{^(source|include|tests|Containerfile)(/|$)};
my ($n_links, @dead) = 0;
find({no_chdir => 1, wanted => sub {
  return unless /\.(md|ipynb)$/;
  my ($page, $folder) = ($_, dirname($_));
  open my $file, '<', $page or die "$page: $!";
  local $/;
  my $text = <$file>;
  $text =~ s/^```.*?^```//gms; # code
  while ($text =~ /\]\(([^()\s#]+)(?:#[^()\s]*)?\)/g) {
    my $link = $1;
    next if $link =~ /^\w+:/;
    ++$n_links;
    next if -e "$folder/$link";
    my $place = "$folder/$link";
    1 while $place =~ s{[^/]+/\.\./}{};
    $place =~ s{^\Q$directory\E/}{};
    push @dead, "$page: $link" unless $place =~ $not_installed;
  }
}}, $directory);
die "links.pl: only $n_links links in $directory\n" if $n_links < 100;
print "$_\n" for sort @dead;
print "dead links: " . @dead . "\n";
