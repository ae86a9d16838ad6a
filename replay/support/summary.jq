# One line for people from the JSON that evaluator writes: replay/run's last word on a system.
def rounded(places): . * pow(10; places) | round / pow(10; places);
def mm: "\(. * 1000 | rounded(1)) mm";
def percent: "\(. * 100 | rounded(1)) %";
def errors: "mean \(.translation_m.mean | mm), RMSE \(.translation_m.rmse | mm), p95 \(.translation_m.p95 | mm), "
  + "max \(.translation_m.max | mm); rotation \(.rotation_deg.mean | rounded(3)) deg mean";
if .absolute then
  "error \(.absolute | errors); coverage \(.association.coverage | percent) of \(.estimate.poses) poses"
else
  "relations \(.relations.error | errors); \(.relations.matched) of \(.relation_file.poses) relations"
end
