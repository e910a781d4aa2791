// Two links that meet under an angle of that sine; r: how much larger the numbers are whose difference closes the loop.
const steep=(s,r)=>M(1,(1+Q(1-(s=I(A(s),1))*s))/s*Q(M(r,1))/REGULAR);
// What is found by iteration along the way from the sketch is kept for the latest design.
let kept,solve;
const sweep=(design,strokes,rates)=>{
  const d=[...design];
  if(!kept||d.some((v,k)=>v!==kept[k])){kept=d;solve=solved(d);}
  const n=strokes.length?strokes[0].length:1,values=Array.from({length:ROWS},()=>new Float64Array(n));
  const reason=new Int16Array(n),missing=new Float64Array(n),pose=places(d);
  let short;
  for(let i=0;i<n;i++){
    const p=strokes.map(s=>s[i]);
    solve(p);
    RATES.forEach((k,j)=>{p[k]=rates?rates[j][i]:0;});
    const v=pose(p);
    let k=0;
    while(k<CHECKS&&v[ROWS+k]-v[ROWS+k]===0)k++;
    if(k<CHECKS){
      reason[i]=k+1;
      missing[i]=(short=short||gaps(d))(p)[k];
      if(!(missing[i]>0))missing[i]=NaN;
    }
    for(let r=0;r<ROWS;r++)values[r][i]=k<CHECKS&&!fixed.has(r)?NaN:A(v[r])<1/0?v[r]:NaN;
    for(const [rows,loops] of refused){
      let t=REGULAR;
      for(const j of loops)t*=steep(v[ROWS+CHECKS+2*j],v[ROWS+CHECKS+2*j+1]);
      if(!(t<=REFUSE))for(const r of rows)values[r][i]=NaN;
    }
  }
  return {values,reason,missing};
};
